// SPDX-License-Identifier: BSD-2-Clause
"use strict";
// The printed report, or the PDF by the browser: light colours, sections opened.

const printing = {
  dark: false,
  opened: []
};

addEventListener("beforeprint", () => {
  const all = [...document.querySelectorAll("#certificate, #more details")];
  printing.opened = all.filter((one) => !one.open);
  for (const one of printing.opened) one.open = true;
  printing.dark = document.documentElement.classList.contains("dark");
  if (printing.dark) setScheme(false);
});

addEventListener("afterprint", () => {
  for (const one of printing.opened) one.open = false;
  if (printing.dark) setScheme(true);
});
