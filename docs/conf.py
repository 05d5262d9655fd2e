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
exclude_patterns = ["_build"]
# Copied commands come without the prompt and the output.
copybutton_prompt_text = "$ "
copybutton_line_continuation_character = "\\"
