// Shows the runs behind a number, each with the commands that make it again.

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
// values: of the runs, where no measure of theirs is what is shown.
function showRuns(title, quantity, keys, values = []) {
  content.replaceChildren();
  add(content, 'h2', title);
  for (const [i, key] of keys.entries()) {
    const run = runs[key];
    if (!run) { add(content, 'p', 'Run ' + key + ' belongs to no job of this campaign.'); continue; }
    const measure = quantity in measureOf ? measureOf[quantity] : quantity;
    const number = values.length > 0 ? values[i] : quantity === 'time' ? run.wall + ' s (' + run.mode + ')' : run.measures[measure];
    add(content, 'h3', run.method + ', replicate ' + run.replicate + ', seed ' + run.seed
      + (number === undefined ? '' : ': ' + number));
    add(content, 'p', 'Key ' + key + ', outcome ' + run.outcome + (run.reason ? ' (' + run.reason + ')' : '')
      + '. Commit ' + run.commit + (run.dirty ? ' with uncommitted changes' : '') + ', ' + run.compiler + '. Host '
      + run.host + ', ' + run.cpu + ', started ' + run.start + '. Its time: ' + run.wall + ' s, ' + run.mode + '.');
    add(content, 'pre', 'git checkout ' + run.commit + '\ncmake --preset release && cmake --build build/release --target tamp'
      + '\n# the whole campaign, this run and its metrics among it:\n' + 'build/release/' + page.command
      + (run.parent ? '\n# this packing alone (it starts from the packing ' + run.parent + '):'
                    : '\n# this packing alone:')
      + "\ncat > job.json <<'END'\n" + run.job + '\nEND\nmkdir -p packing && build/release/tamp job job.json --out packing'
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
    + cell.textContent, cell.dataset.q, cell.dataset.k.split(' '),
    (cell.dataset.r || '').split(' ').filter(value => value).map(Number));
  cell.addEventListener('click', open);
  cell.addEventListener('keydown', event => { if (event.key === 'Enter') open(); });
}
dialog.querySelector('button').addEventListener('click', () => dialog.close());
