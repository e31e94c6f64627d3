# SPDX-License-Identifier: BSD-2-Clause
"""Settings of Sphinx for the documentation site, which scripts/docs builds.

The folder of sources is the repository, so that a link from one Markdown file to another is the
same here and where the repository is browsed. Links to files that are no pages, such as cases,
become downloads.
"""
import base64
import re
from pathlib import Path

from docutils import nodes

project = "squeal"
author = "the authors of squeal"
version = re.search(
    r"project\(squeal VERSION (\S+)", (Path(__file__).parents[1] / "CMakeLists.txt").read_text()
)[1]
extensions = ["myst_parser"]
root_doc = "docs/index"
include_patterns = [
    "docs/*.md",
    "options/README.md",
    "meshes/README.md",
    "src/README.md",
    "tests/fuzz/README.md",
    "CONTRIBUTING.md",
    "CHANGELOG.md",
]
exclude_patterns = [".*", "build*", "results"]
highlight_language = "none"
myst_heading_anchors = 3

html_theme = "alabaster"  # it comes with Sphinx, and works without scripts and fonts of its own
html_theme_options = {
    "description": "flutter of brakes in steady sliding",
    "fixed_sidebar": True,
    "page_width": "1240px",
    "sidebar_width": "250px",
    "sidebar_collapse": True,
    "body_max_width": "none",
    "show_powered_by": False,
    "font_family": "system-ui, 'DejaVu Sans', sans-serif",
    "head_font_family": "system-ui, 'DejaVu Sans', sans-serif",
    "code_font_size": "0.85em",
}
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_title = f"squeal {version}"
html_static_path = ["site"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_copyright = False
html_show_search_summary = False  # a browser lets no script read other files
html_math_renderer = "katex"

KATEX = Path("/usr/share/javascript/katex")  # package libjs-katex


def read_formulas(app, name, source):
    """Formulas are written as repositories show them, $`x`$ in a line and $$ above and below; here
    as MyST does."""
    parts = re.split(r"(^```.*?^```$)", source[0], flags=re.M | re.S)
    for i in range(0, len(parts), 2):
        parts[i] = re.sub(
            r"^( *)\$\$\n(.*?)^ *\$\$$", r"\1```{math}\n\2\1```", parts[i], flags=re.M | re.S
        )
        parts[i] = re.sub(r"\$`([^`]+)`\$", r"{math}`\1`", parts[i])
    source[0] = "".join(parts)


def write_inline(self, node):
    self.body.append(
        self.starttag(node, "span", "", CLASS="math") + self.encode(node.astext()) + "</span>"
    )
    raise nodes.SkipNode


def write_display(self, node):
    self.body.append(
        self.starttag(node, "div", "", CLASS="math") + self.encode(node.astext()) + "</div>\n"
    )
    raise nodes.SkipNode


def add_katex(app, page, template, context, doctree):
    """Pages with formulas load KaTeX, others do not."""
    if doctree is not None and next(
        doctree.findall(lambda n: isinstance(n, (nodes.math, nodes.math_block))), None
    ):
        app.add_css_file("katex.css")
        app.add_js_file("katex.min.js", loading_method="defer")
        app.add_js_file("formulas.js", loading_method="defer")


def font_of(name):
    """The address that holds the font itself."""
    content = base64.b64encode((KATEX / name).read_bytes()).decode()
    return f"data:font/woff2;base64,{content}"


def finish(app, error):
    if error or app.builder.name != "html":
        return
    static = Path(app.outdir) / "_static"
    # Browsers may refuse fonts from files beside a page that is a file itself, and take those that
    # the style holds.
    style = (KATEX / "katex.min.css").read_text()
    style = re.sub(r",url\([^)]*\.(woff|ttf)\) format\(['\"]\w+['\"]\)", "", style)
    style = re.sub(r"url\(([^)]*\.woff2)\)", lambda found: f"url({font_of(found[1])})", style)
    (static / "katex.css").write_text(style)
    (static / "katex.min.js").write_bytes((KATEX / "katex.min.js").read_bytes())
    (Path(app.outdir) / "index.html").write_text(
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>squeal</title>'
        f'<meta http-equiv="refresh" content="0; url={root_doc}.html"></head>'
        f'<body><a href="{root_doc}.html">squeal</a></body></html>\n'
    )


def setup(app):
    app.add_html_math_renderer("katex", (write_inline, None), (write_display, None))
    app.connect("source-read", read_formulas)
    app.connect("html-page-context", add_katex)
    app.connect("build-finished", finish)
