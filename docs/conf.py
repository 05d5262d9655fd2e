"""Settings of the book; scripts/build_docs.sh builds it."""

import pathlib
import re

manifest = pathlib.Path(__file__).resolve().parents[1] / "Cargo.toml"
project = "rockfrag"
release = re.search(r'^version = "(.*)"', manifest.read_text(), re.MULTILINE)[1] if manifest.exists() else ""
copyright = "the authors of rockfrag"
extensions = ["myst_parser", "sphinx.ext.mathjax", "sphinx_copybutton"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = f"rockfrag {release}"
# No links to the source above a page: they stand outside of its landmarks.
html_theme_options = {"top_of_page_buttons": []}
html_copy_source = False
exclude_patterns = ["_build"]
# Copied commands come without the prompt and the output.
copybutton_prompt_text = "$ "
copybutton_line_continuation_character = "\\"

# What screen readers and the keyboard miss in pages of the theme, and what they need.
MENDED = {
    '<p class="caption" role="heading">': '<p class="caption" role="heading" aria-level="2">',
    '<aside class="sidebar-drawer">': '<aside class="sidebar-drawer" aria-label="All pages">',
    '<aside class="toc-drawer': '<aside aria-label="On this page" class="toc-drawer',
    '<div class="highlight"><pre>': '<div class="highlight"><pre tabindex="0">',
    '<div class="table-wrapper': '<div tabindex="0" class="table-wrapper',
    '<th class="head"><p></p></th>': "<td></td>",
    '<div id="search-results"></div>': '<h1>Search</h1>\n<div id="search-results" class="results"></div>',
}


def mend(app, failure):
    for page in pathlib.Path(app.outdir).rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        for found, put in MENDED.items():
            text = text.replace(found, put)
        page.write_text(text, encoding="utf-8")


def setup(app):
    app.connect("build-finished", mend)
