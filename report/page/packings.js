// The controls of the picture: which packing, what colours mean, where it is cut.

function startPackings(box) {
  const control = name => box.querySelector('[name=' + name + ']');
  const state = box.querySelector('.state');
  const blocks = [...document.querySelectorAll('script.packing')];
  for (const [i, block] of blocks.entries()) control('packing').add(new Option(block.dataset.title, i));

  let view;
  const read = new Map(); // packings that have been asked for
  const colour = () => {
    const tone = tones[control('colour').value](view.packing);
    view.colour(tone.values);
    box.classList.toggle('two', control('colour').value === 'stability');
    const [low, high] = box.querySelectorAll('.legend span');
    low.textContent = tone.low;
    high.textContent = tone.high;
    state.textContent = describe(view.packing) + ' ' + tone.words;
  };
  const show = () => {
    const block = blocks[control('packing').value];
    if (!read.has(block)) read.set(block, readPacking(block));
    view.show(read.get(block));
    box.classList.toggle('flat', view.packing.dimension === 2);
    colour();
  };
  const cut = () => {
    view.cuts = [0, 1, 2].map(a => Number(control('cut' + a).value));
    view.ask();
  };

  const start = () => {
    try {
      view = new PackingView(box.querySelector('canvas'));
    } catch (error) {
      state.textContent = error.message;
      return;
    }
    makeTurning(view);
    box.view = view;
    box.classList.add('drawn');
    control('packing').addEventListener('change', show);
    control('colour').addEventListener('change', colour);
    for (const a of [0, 1, 2]) control('cut' + a).addEventListener('input', cut);
    control('home').addEventListener('click', () => {
      for (const a of [0, 1, 2]) control('cut' + a).value = 1;
      cut();
      view.home();
    });
    show();
  };
  // Nothing is decoded before the reader comes near.
  const watch = new IntersectionObserver(entries => {
    if (!entries.some(entry => entry.isIntersecting)) return;
    watch.disconnect();
    start();
  }, {rootMargin: '50%'});
  watch.observe(box);
}

function describe(packing) {
  const {size, unit, dimension, count, shown, height, whole, boundary} = packing;
  const kind = dimension === 2 ? ' discs' : ' spheres';
  const number = n => n.toLocaleString('en').replace(/,/g, ' ');
  const box = size.slice(0, dimension).map(round3).join(' × ') + ' ' + unit;
  const sides = boundary[0] === 'periodic' ? ', periodic: what reaches through a face is cut there and goes on at the other'
    : '';
  if (whole) return number(count) + kind + ' in a box of ' + box + sides + '.';
  return 'A part: the lowest ' + round3(height) + ' ' + unit + ' of a box of ' + box + sides + ', with ' + number(shown)
    + ' of its ' + number(count) + kind + '. Those cut by its faces are grey where contacts count.';
}

for (const box of document.querySelectorAll('.view')) startPackings(box);
