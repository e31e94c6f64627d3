// SPDX-License-Identifier: BSD-2-Clause
// Sets the formulas of a page by KaTeX.
for (const place of document.querySelectorAll(".math"))
  katex.render(
      place.textContent, place, {displayMode: place.tagName === "DIV", throwOnError: false});
