"""The digest of code: which files are in it.  What counts in them is tested with the sweeps, tests/sweeps/test_work.py."""

from softlube.solvers.code_version import NUMERICS, STEADY, code_version, package_folder


def test_a_version_has_files_and_names_them_by_folder():
    for pattern in STEADY:
        assert list(package_folder().glob(pattern)), pattern
    assert code_version(NUMERICS) != code_version(STEADY)
    assert code_version(STEADY) == code_version(tuple(STEADY))
