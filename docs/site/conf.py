"""conf.py - how Sphinx makes the site out of the pages that pages.py has laid out."""
import datetime
import os

project = "bulla"
author = "the authors of bulla"
release = version = os.environ.get("BULLA_VERSION", "")
html_title = f"bulla {release}".strip()
html_last_updated_fmt = None  # the same source gives the same site
copyright = str(datetime.date.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", "0"))).year) if os.environ.get(
    "SOURCE_DATE_EPOCH") else ""
html_show_copyright = bool(copyright)
html_show_sphinx = False

extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = []
myst_heading_anchors = 4  # the anchors that links in the sources name
source_suffix = {".md": "markdown"}
highlight_language = "none"  # indented blocks are commands and formulas

# Served from the site itself: no page asks another machine for anything.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML"
mathjax2_config = {"showMathMenu": False, "messageStyle": "none"}

html_static_path = ["_static"]
html_css_files = ["site.css"]
html_copy_source = False
if os.environ.get("BULLA_SITE_CHECK"):  # for faults alone: furo lists all pages beside each, most of its time
    html_theme = "basic"
else:
    html_theme = "furo"
    html_theme_options = {
        "light_css_variables": {"color-brand-primary": "#0b6e75", "color-brand-content": "#0b6e75"},
        "dark_css_variables": {"color-brand-primary": "#5cc5c9", "color-brand-content": "#5cc5c9"},
    }
