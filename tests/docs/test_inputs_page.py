"""The tables of docs/reference/inputs.md are the declarations, and its example is a liquid."""

from pathlib import Path

import softlube
from softlube.model.cylinders import Cylinder
from softlube.model.parts import Part
from softlube.physical.inputs import SLIDING_BODIES, Approach, LineLoading, Loading, Measured, StartOfSliding

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "inputs.md"


def row(owner, each):
    unit = each.unit or ("text" if each.is_text else "1")
    return f"| {owner} | `{each.name}` | {unit} | {each.help} |"


def test_every_input_stands_in_the_tables():
    lines = PAGE.read_text(encoding="utf-8").splitlines()
    kinds = [Part.slots[slot] | Part.additions.get(slot, {}) for slot in SLIDING_BODIES]
    parts = [kind for slot in kinds for kind in slot.values() if kind.__module__.startswith("softlube.")]
    expected = [row(f"`{kind.__name__}`", each) for kind in parts for each in kind.inputs.values()]
    groups = {"steady sliding": Loading, "squeeze film": Approach, "start of sliding": StartOfSliding, "measurement": Measured}
    groups["line contact"] = LineLoading
    expected += [row("`Cylinder`", each) for each in Cylinder.inputs.values()]
    expected += [row(name, each) for name, group in groups.items() for each in group.inputs.values()]
    missing = [line for line in expected if line not in lines]
    assert not missing, "\n".join(missing)
    tabled = [
        line for line in lines if line.startswith("| ") and line.split("|")[2].startswith(" `") and line.split("|")[2].islower()
    ]
    assert len(tabled) == len(expected)


def test_both_spellings_of_the_page_are_one_contact():
    blocks = PAGE.read_text(encoding="utf-8").split("```python\n")[1:]
    names = {}
    exec(blocks[0].split("```")[0], names)
    assert names["contact"] == names["twin"]
    assert isinstance(names["contact"], softlube.Contact)
