// Sorts a table by the column whose heading is clicked.

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
