"""The page in a real browser: it sorts, tells where numbers come from, draws packings, asks nothing of the network.

usage: page_test.py TAMP [unittest's options]; exits with 77, for ctest's "skipped", where there is no Chromium.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import chromium

HERE = os.path.dirname(os.path.abspath(__file__))
# Waits until the picture is there, then draws it at once and counts the pixels that differ from those kept before.
DRAW = """
const box = document.querySelector('.view'), view = box.view;
const set = (name, value, event = 'change') => {
  const control = box.querySelector('[name=' + name + ']');
  control.value = value;
  control.dispatchEvent(new Event(event));
};
const pixels = () => {
  view.draw();
  const gl = view.renderer.getContext();
  const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  return bytes;
};
const share = f => {
  const bytes = pixels();
  let n = 0;
  for (let i = 0; i < bytes.length; i += 4) n += f(bytes, i) ? 1 : 0;
  return 4 * n / bytes.length;
};
const changed = old => share((bytes, i) => [0, 1, 2, 3].some(c => bytes[i + c] !== old[i + c]));
"""


def tamp(folder, *arguments):
    subprocess.run([TAMP, *arguments], cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=300)


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="tamp-page-")
        shutil.copy(os.path.join(HERE, "campaign.json"), cls.folder)
        tamp(cls.folder, "run", "campaign.json")
        tamp(cls.folder, "report", "campaign.json", "--out", "report")
        cls.path = os.path.join(cls.folder, "report", "index.html")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def open(self, **options):
        page = chromium.Page(self.path, **options)
        self.addCleanup(self.close, page)
        return page

    def close(self, page):
        """No page may end with an error, nor with a request to anything but itself."""
        others = [url for url in page.requests if not url.startswith(("file://" + self.folder, "data:", "blob:"))]
        page.__exit__()
        self.assertEqual(page.problems, [])
        self.assertEqual(others, [])
        self.assertTrue(page.requests)  # else nobody has listened

    def draw(self, page, script):
        """Runs the script, with DRAW's words, once the picture is there."""
        if not page.run("!!document.querySelector('.view')"):
            self.skipTest("tamp was built without libjs-three")
        page.run("document.querySelector('.view').scrollIntoView()")
        page.wait(lambda: page.run("!!document.querySelector('.view').view"))
        return page.run("(() => {" + DRAW + script + "})()")

    def test_a_click_sorts_numbers_as_numbers_and_a_second_one_turns_the_order(self):
        page = self.open()
        checked = page.run("""(() => {
          let columns = 0;
          const orders = [];
          for (const table of document.querySelectorAll('table')) for (const head of table.tHead.rows[0].cells) {
            const values = () => [...table.tBodies].map(body => body.rows[0].cells[head.cellIndex].dataset.v).map(Number);
            if (table.tBodies.length < 2 || values().some(Number.isNaN)) continue;
            head.click();
            const up = values();
            head.click();
            const down = values();
            ++columns;
            orders.push([up, down]);
          }
          return {columns, orders};
        })()""")
        self.assertGreater(checked["columns"], 10)
        for up, down in checked["orders"]:
            self.assertEqual(up, sorted(up))
            self.assertEqual(down, sorted(down, reverse=True))
        # Words would put 10 before 9.
        order = page.run("""(() => {
          const table = document.createElement('table');
          table.innerHTML = '<thead><tr><th>x</th></tr></thead>' + [10, 9, 100].map(v =>
            `<tbody><tr><td data-v="${v}">${v}</td></tr></tbody>`).join('');
          document.body.append(table);
          sortBy(table.tHead.rows[0].cells[0]);
          const found = [...table.tBodies].map(body => body.textContent).join(' ');
          table.remove();
          return found;
        })()""")
        self.assertEqual(order, "9 10 100")

    def test_every_number_tells_key_commit_seed_and_command(self):
        page = self.open()
        dialogs = page.run("""[...document.querySelectorAll('td[data-k]')].map(cell => {
          cell.click();
          const dialog = document.querySelector('dialog');
          const found = {open: dialog.open, keys: cell.dataset.k.split(' '), text: dialog.textContent};
          dialog.querySelector('button').click();
          return {...found, closed: !dialog.open};
        })""")
        runs = page.run("runs")
        self.assertGreater(len(dialogs), 20)
        for dialog in dialogs:
            self.assertTrue(dialog["open"] and dialog["closed"])
            for key in dialog["keys"]:
                for words in (key, runs[key]["commit"], f"seed {runs[key]['seed']}", "tamp run campaign.json", "tamp job job.json"):
                    self.assertIn(words, dialog["text"])
        decided = page.run("""[...document.querySelectorAll('#decision td[data-k]')].map(cell => {
          cell.click();
          const heads = [...document.querySelectorAll('dialog h3')].map(head => Number(head.textContent.split(': ').pop()));
          document.querySelector('dialog button').click();
          return {heads, mean: Number(cell.dataset.v)};
        })""")
        for cell in decided:  # of each run its own number, whose mean the cell shows
            self.assertAlmostEqual(sum(cell["heads"]) / len(cell["heads"]), cell["mean"], delta=1e-6 * abs(cell["mean"]))

    def test_no_identifier_occurs_twice(self):
        page = self.open()
        self.assertEqual(page.run("(ids => ids.filter((id, i) => ids.indexOf(id) !== i))([...document.querySelectorAll('[id]')].map(e => e.id))"), [])
        used = page.run("[...document.querySelectorAll('svg use')].map(e => (e.href || {}).baseVal || e.getAttribute('xlink:href'))")
        for name in set(used):
            self.assertTrue(page.run(f"document.querySelector('{name}') !== null"), name)

    def test_the_printed_commands_make_the_same_packings_again(self):
        page = self.open()
        runs = page.run("runs")
        parents = [key for key in runs if runs[key]["parent"]]
        key = parents[-1]  # its commands name the parent's packing too
        commands = page.run(f"showRuns('t', 'N_part', ['{key}']), document.querySelector('dialog pre').textContent")
        self.assertIn("git checkout " + runs[key]["commit"], commands)
        with tempfile.TemporaryDirectory() as fresh:
            os.makedirs(os.path.join(fresh, "build/release"))
            os.symlink(TAMP, os.path.join(fresh, "build/release/tamp"))
            shutil.copy(os.path.join(HERE, "campaign.json"), fresh)
            rest = re.sub(r"^(git|cmake) .*\n", "", commands, flags=re.M)  # the program is there already
            subprocess.run(["bash", "-euc", rest], cwd=fresh, check=True, capture_output=True, timeout=300)
            name = f"{key}.h5"
            packings = [os.path.join(folder, at) for folder, at in ((self.folder, f"tamp-store/packings/{key[:2]}/{name}"),
                        (fresh, f"tamp-store/packings/{key[:2]}/{name}"), (fresh, f"packing/{name}"))]
            contents = [pathlib.Path(path).read_bytes() for path in packings]
            self.assertEqual(contents[0], contents[1])
            self.assertEqual(contents[0], contents[2])

    def test_links_within_the_page_lead_somewhere(self):
        page = self.open()
        links = page.run("[...document.querySelectorAll('a')].map(a => a.getAttribute('href'))")
        self.assertGreater(len(links), 2)
        for link in links:
            self.assertTrue(page.run(f"!!document.getElementById({json.dumps(link[1:])})"), link)

    def test_the_picture_is_there_and_answers_to_every_control(self):
        page = self.open()
        found = self.draw(page, """
          const found = {};
          for (const block of document.querySelectorAll('script.packing')) {
            const i = [...document.querySelectorAll('script.packing')].indexOf(block);
            set('packing', i);
            found['filled ' + i] = share((bytes, at) => bytes[at + 3] > 0);
            let old = pixels();
            found['unchanged ' + i] = changed(old);
            for (const colour of ['coordination', 'stability']) {
              set('colour', colour);
              found[colour + ' ' + i] = changed(old);
              old = pixels();
            }
            set('cut0', 0.5, 'input');
            found['cut ' + i] = changed(old);
            old = pixels();
            box.querySelector('[name=home]').click();
            found['home ' + i] = changed(old);
            set('colour', 'radius');
          }
          return found;""")
        self.assertEqual(len([name for name in found if name.startswith("filled")]), 8)
        for name, share in found.items():
            if name.startswith("unchanged"):
                self.assertEqual(share, 0, name)
            elif name.startswith("stability"):
                self.assertGreater(share, 0.01, name)
            else:
                self.assertGreater(share, 0.05, name)

    def test_dragging_turns_the_picture(self):
        page = self.open()
        self.draw(page, "set('packing', 2); box.scrollIntoView(); window.old = pixels()")
        place = page.run("(() => { const r = document.querySelector('.view canvas').getBoundingClientRect();"
                         "return [r.x + r.width / 2, r.y + r.height / 2] })()")
        yaw = page.run("document.querySelector('.view').view.yaw")
        page.drag(*place, 60, 25)
        self.assertNotEqual(page.run("document.querySelector('.view').view.yaw"), yaw)
        self.assertGreater(self.draw(page, "return changed(window.old)"), 0.05)

    def test_contacts_and_stability_are_those_of_the_metrics(self):
        page = self.open()
        compared = self.draw(page, """
          return [...document.querySelectorAll('script.packing')].map(block => {
            const packing = readPacking(block), measures = runs[packing.key].measures;
            const z = findContacts(packing).map(list => list.filter(contact => contact.partner >= 0).length);
            const mean = z.reduce((a, b) => a + b, 0) / z.length;
            return [mean, measures.z, parseInt(tones.stability(packing).words), measures.unstable_count,
              packing.whole, z.length, measures.N];
          });""")
        self.assertEqual(len(compared), 8)
        for mean, z, moving, unstable, whole, count, n in compared:
            self.assertTrue(whole)
            self.assertEqual(count, n)
            self.assertAlmostEqual(mean, z, places=9)
            self.assertEqual(moving, unstable)
        self.assertGreater(max(row[3] for row in compared), 0)

    def test_thirty_thousand_spheres_take_few_draw_calls(self):
        page = self.open()
        found = self.draw(page, """
          const n = 30000, edge = 32, centres = new Float64Array(3 * n);
          for (let i = 0; i < n; ++i) centres.set([i % edge, Math.floor(i / edge) % edge, Math.floor(i / edge / edge)]
            .map(x => x + 0.5), 3 * i);
          view.show({dimension: 3, size: [edge, edge, edge], boundary: ['wall', 'wall', 'wall'], centres, unit: 'm',
            radii: new Float64Array(n).fill(0.5), whole: true, gap: 1e-6});
          view.colour(new Float64Array(n).fill(0.5));
          const times = [];
          for (let k = 0; k < 5; ++k) {
            view.yaw += 0.05;
            const start = performance.now();
            pixels();
            times.push(performance.now() - start);
          }
          return {calls: view.renderer.info.render.calls, time: Math.min(...times), filled: share((b, i) => b[i + 3] > 0),
            size: [view.canvas.width, view.canvas.height]};""")
        print(f"30 000 spheres at {found['size']} in software: {found['time']:.0f} ms a frame, {found['calls']} draw calls")
        self.assertLessEqual(found["calls"], 8)
        self.assertGreater(found["filled"], 0.2)

    def test_the_page_fits_a_phone(self):
        page = self.open(width=390, height=844)
        self.assertLessEqual(page.run("document.documentElement.scrollWidth"), 390)
        self.assertGreater(self.draw(page, "return share((bytes, i) => bytes[i + 3] > 0)"), 0.2)
        page.run("document.querySelector('td[data-k]').click()")
        self.assertEqual(page.run("(d => d.scrollWidth - d.clientWidth)(document.querySelector('dialog'))"), 0)

    def test_dark_and_light_follow_the_reader(self):
        for dark in (False, True):
            page = self.open(dark=dark)
            paper, ink = [sum(map(int, re.findall(r"\d+", page.run(f"getComputedStyle(document.body).{name}"))[:3]))
                          for name in ("backgroundColor", "color")]
            self.assertEqual(paper < ink, dark)

    def test_print_is_black_on_white_without_controls(self):
        page = self.open(dark=True)
        self.draw(page, "")
        page.call("Emulation.setEmulatedMedia", media="print", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.assertEqual(page.run("getComputedStyle(document.body).color"), "rgb(0, 0, 0)")
        for what in (".controls", "nav", ".help"):
            self.assertEqual(page.run(f"getComputedStyle(document.querySelector('{what}')).display"), "none", what)
        self.assertEqual(page.run("[...document.querySelectorAll('.wide')].filter(e => getComputedStyle(e).overflowX !== 'visible')"
                                  ".length"), 0)
        pdf = os.path.join(self.folder, "page.pdf")
        page.pdf(pdf)
        with open(pdf, "rb") as file:
            self.assertEqual(file.read(5), b"%PDF-")
        self.assertEqual(page.run("document.querySelectorAll('section details:not([open])').length"), 0)


if __name__ == "__main__":
    TAMP = os.path.abspath(sys.argv.pop(1))
    if not chromium.find():
        print("skipped: no program chromium (Debian package chromium)")
        sys.exit(77)
    unittest.main()
