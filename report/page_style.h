// The page's style sheet: one column, dark and light as the reader's device says, black on white in print.
#pragma once

#include <string_view>

namespace tamp {

inline constexpr std::string_view kPageStyle = R"css(
:root{color-scheme:light dark;--ink:#1b1f24;--soft:#59636e;--paper:#fff;--line:#d1d9e0;--tint:#f3f6f9;--link:#0550ae}
@media (prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#9aa5b1;--paper:#0f141a;--line:#313a44;--tint:#19212a;--link:#79b8ff}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:75rem;padding:1rem;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif}
h1{line-height:1.2}h2{font-size:1.15rem;margin-top:2.5rem}h3{font-size:1rem;margin:1.2rem 0 .4rem}
a{color:var(--link)}nav a{margin-right:1em;display:inline-block;padding:.3em 0}
small,figcaption,.soft{color:var(--soft)}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.9rem;font-variant-numeric:tabular-nums}
th,td{padding:.3em .7em;text-align:right;white-space:nowrap}
th:first-child,tbody tr td:nth-child(2):not([data-v]){text-align:left}
thead th{border-top:2px solid;border-bottom:1px solid;cursor:pointer}
thead th[aria-sort=ascending]::after{content:" ▲"}thead th[aria-sort=descending]::after{content:" ▼"}
tbody{border-bottom:1px solid var(--line)}
td[data-k]{cursor:pointer;text-decoration:underline dotted var(--soft);text-underline-offset:.25em}
td[data-k]:hover,td[data-k]:focus,thead th:hover{background:var(--tint)}
figure{margin:1rem 0;background:#fff;color:#1b1f24;border:1px solid var(--line);padding:.5rem}
figure svg{width:100%;height:auto;max-height:85vh}figcaption{color:#59636e;padding:.3rem .5rem}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,30rem),1fr));gap:1rem}
dialog{max-width:min(60rem,95vw);max-height:90vh;border:1px solid var(--line);background:var(--paper);color:var(--ink)}
dialog::backdrop{background:#0008}
pre{white-space:pre-wrap;overflow-wrap:anywhere;background:var(--tint);padding:.6rem;font-size:.8rem}
button{font:inherit}
@media print{:root{--ink:#000;--soft:#444;--paper:#fff}body{max-width:none;font-size:10pt}nav,dialog{display:none}
.wide{overflow:visible}table{font-size:7pt}section,figure{break-inside:avoid}td[data-k]{text-decoration:none}}
)css";

} // namespace tamp
