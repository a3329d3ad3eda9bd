// What a packing can be coloured by: a number from 0 to 1 for each sphere, negative where it is not known, and a legend.

// Five stops of viridis, which keeps its order for colour-blind readers and in grey.
const viridis = [[0.267, 0.005, 0.329], [0.229, 0.322, 0.546], [0.128, 0.567, 0.551], [0.369, 0.789, 0.383],
  [0.993, 0.906, 0.144]];

// Numbers that several colourings of a packing need, kept with it.
function contactsOf(packing) {
  packing.contacts = packing.contacts || findContacts(packing);
  return packing.contacts;
}

const round3 = x => Number(x.toPrecision(3)).toString();

const tones = {
  radius(packing) {
    let least = Infinity, most = 0;
    for (const r of packing.radii) { least = Math.min(least, r); most = Math.max(most, r); }
    const range = Math.log(most / least);
    return {values: packing.radii.map(r => range > 0 ? Math.log(r / least) / range : 0.5),
      low: 'radius ' + round3(least), high: round3(most) + ' ' + packing.unit + ' (logarithmic)', words: ''};
  },

  coordination(packing) {
    const most = packing.dimension === 2 ? 6 : 12;
    const contacts = contactsOf(packing);
    let sum = 0, known = 0;
    const values = packing.radii.map((_, i) => {
      if (isCut(packing, i)) return -1;
      const z = contacts[i].filter(contact => contact.partner >= 0).length;
      sum += z;
      ++known;
      return Math.min(z, most) / most;
    });
    return {values, low: '0 contacts', high: most + ' or more', words: 'Mean ' + (known ? (sum / known).toFixed(3) : '–')
      + ' contacts with other spheres, walls not counted.'};
  },

  stability(packing) {
    const contacts = contactsOf(packing);
    let unstable = 0, known = 0;
    const values = packing.radii.map((_, i) => {
      if (isCut(packing, i)) return -1;
      const rests = freeDescent(contacts[i].map(contact => contact.normal), packing.dimension) <= packing.gap;
      unstable += rests ? 0 : 1;
      ++known;
      return rests ? 0.5 : 1;
    });
    return {values, low: 'teal: rests', high: 'yellow: would move', words: unstable + ' of ' + known
      + ' would move if their neighbours were held.'};
  },
};
