"""The page stands alone: it refers to nothing outside itself, is small, and its script cannot be ended by its data."""

import re

import pytest

from softlube.plots.calculator.page import embedded, page

LARGEST = 600_000
"""Bytes that the page may have."""


@pytest.fixture(scope="module")
def text():
    return page()


def test_it_is_small(text):
    assert len(text.encode()) < LARGEST


def test_it_refers_to_nothing_outside(text):
    for attribute in re.findall(r"(?:src|href|action|srcset)\s*=\s*[\"']([^\"']*)", text):
        assert attribute.startswith(("#", "data:"))
    assert "@import" not in text
    assert "url(" not in text
    assert "default-src 'none'" in text


def test_the_licence_of_what_is_bundled_is_there(text):
    assert "Permission is hereby granted, free of charge" in text
    assert "Leon Sorokin" in text


def test_data_end_no_script():
    assert "</" not in embedded({"a": "</script><script>"})
