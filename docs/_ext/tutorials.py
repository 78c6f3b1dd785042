"""Tutorials from the scripts of examples/: their order, and the pictures that they write."""

import shutil
from pathlib import Path

from sphinx_gallery.scrapers import figure_rst

ORDER = (
    "first_contact",
    "stribeck_curve",
    "fit_viscosity",
    "hyaluronic_acid",
    "layer_under_lens",
    "pdms_memory",
    "worn_ball",
    "squeeze_dimple",
    "killed_sweep",
    "read_solution",
)


class Order:
    """Sorts scripts as a newcomer would read them."""

    def __init__(self, folder):
        self.folder = folder

    def __call__(self, name):
        """Place of the script."""
        return ORDER.index(Path(name).stem)


def pictures(block, block_vars, gallery_conf):
    """Take the PNG files that a block of a script has written."""
    folder = Path(block_vars["src_file"]).parent
    paths = []
    for picture in sorted(folder.glob("*.png")):
        target = next(block_vars["image_path_iterator"])
        shutil.move(picture, target)
        paths.append(target)
    return figure_rst(paths, gallery_conf["src_dir"])
