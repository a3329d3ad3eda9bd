// What the page knows besides its tables: how it was made, and the runs behind its numbers, by key.
const page = JSON.parse(document.getElementById('page').textContent);
const runs = JSON.parse(document.getElementById('runs').textContent);
