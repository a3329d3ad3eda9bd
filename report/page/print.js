// Opens the notes for print, where nobody can.
window.addEventListener('beforeprint', () => {
  for (const details of document.querySelectorAll('section details')) details.open = true;
});
