"""The calculator: one page that computes contacts in a browser, without server or network.

Depends on: `physical`, `theory` and all above them.  `export` says what the page knows of them; `page` writes it.
The folder `web` has its template, styles and scripts; after a change there, `python .ci/calculator_bundle.py` bundles them
anew.
"""
