// The page's behaviour: sorts tables by a column, and shows the runs behind a number.
#pragma once

#include <string_view>

namespace tamp {

inline constexpr std::string_view kPageScript = R"js(
'use strict';
const page = JSON.parse(document.getElementById('page').textContent);
const runs = JSON.parse(document.getElementById('runs').textContent);

// A column sorts whole groups by their first line; a second click turns the order.
for (const head of document.querySelectorAll('thead th')) {
  head.tabIndex = 0;
  head.addEventListener('click', () => sortBy(head));
  head.addEventListener('keydown', event => { if (event.key === 'Enter') sortBy(head); });
}
function sortBy(head) {
  const table = head.closest('table');
  const column = head.cellIndex;
  const down = head.getAttribute('aria-sort') === 'ascending';
  for (const other of table.tHead.rows[0].cells) other.removeAttribute('aria-sort');
  head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
  const value = body => {
    const cell = body.rows[0].cells[column];
    return cell.dataset.v === undefined ? cell.textContent : Number(cell.dataset.v);
  };
  const compare = (a, b) => typeof a === 'number' && typeof b === 'number' ? a - b
    : typeof a === 'number' ? -1 : typeof b === 'number' ? 1 : a.localeCompare(b, 'en');
  const bodies = [...table.tBodies];
  bodies.sort((a, b) => (down ? -1 : 1) * compare(value(a), value(b)));
  table.append(...bodies);
}

const dialog = document.querySelector('dialog');
const content = dialog.querySelector('div');
function add(parent, tag, text) {
  const element = document.createElement(tag);
  element.textContent = text;
  parent.append(element);
  return element;
}
// The measure a column shows, as far as it is one number of each run.
const measureOf = {N_part: 'N', K: 'bins', time: null};
function showRuns(title, quantity, keys) {
  content.replaceChildren();
  add(content, 'h2', title);
  for (const key of keys) {
    const run = runs[key];
    if (!run) { add(content, 'p', 'Run ' + key + ' belongs to no job of this campaign.'); continue; }
    const measure = quantity in measureOf ? measureOf[quantity] : quantity;
    const number = quantity === 'time' ? run.wall + ' s (' + run.mode + ')' : run.measures[measure];
    add(content, 'h3', run.method + ', replicate ' + run.replicate + ', seed ' + run.seed
      + (number === undefined ? '' : ': ' + number));
    add(content, 'p', 'Key ' + key + ', outcome ' + run.outcome + (run.reason ? ' (' + run.reason + ')' : '')
      + '. Commit ' + run.commit + (run.dirty ? ' with uncommitted changes' : '') + ', ' + run.compiler + '. Host '
      + run.host + ', ' + run.cpu + ', started ' + run.start + '. Its time: ' + run.wall + ' s, ' + run.mode + '.');
    add(content, 'pre', 'git checkout ' + run.commit + '\ncmake --preset release && cmake --build build/release --target tamp'
      + '\n# the whole campaign, this run and its metrics among it:\n' + page.command
      + (run.parent ? '\n# this packing alone (it starts from the packing ' + run.parent + '):'
                    : '\n# this packing alone:')
      + "\ncat > job.json <<'END'\n" + run.job + '\nEND\nbuild/release/tamp job job.json --out packing'
      + (run.parent ? ' --parent ' + page.store + '/packings/' + run.parent.slice(0, 2) + '/' + run.parent + '.h5' : ''));
    const details = add(content, 'details', '');
    add(details, 'summary', 'All numbers of this run');
    add(details, 'pre', JSON.stringify({measures: run.measures, 'keys of metrics': run.metrics}, null, 1));
  }
  dialog.showModal();
  content.scrollTop = 0;
}
for (const cell of document.querySelectorAll('td[data-k]')) {
  const open = () => showRuns(cell.closest('tbody').rows[0].cells[0].textContent + ', ' + cell.dataset.q + ': '
    + cell.textContent, cell.dataset.q, cell.dataset.k.split(' '));
  cell.addEventListener('click', open);
  cell.addEventListener('keydown', event => { if (event.key === 'Enter') open(); });
}
dialog.querySelector('button').addEventListener('click', () => dialog.close());
)js";

} // namespace tamp
