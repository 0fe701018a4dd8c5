# SPDX-License-Identifier: BSD-3-Clause
"""`freespace report`: the page in a browser, what is taken up, and one sentence for every bad input.

The browser is Debian's (chromium, chromium-driver, python3-selenium); without it those tests are skipped.
"""
import base64
import json
import os
import re
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkIOImage import vtkPNGReader

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    DRIVER = shutil.which('chromedriver')
except ImportError:
    DRIVER = None

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = os.environ['FREESPACE_PROGRAM']
SCENE = ROOT / 'Examples' / 'Data' / 'blocks'
CLUSTERS = 6


def run(*arguments, cwd=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=300)


def pixels(png):
    """The pixels of a PNG as an array (height, width, channels)."""
    with tempfile.NamedTemporaryFile(suffix='.png') as file:
        file.write(png)
        file.flush()
        reader = vtkPNGReader()
        reader.SetFileName(file.name)
        reader.Update()
        image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[..., :3].astype(int)


def small_scene(folder, name='cluster1', **changes):
    """A scene of one cluster, in a folder of its own that tests may damage."""
    scene = json.loads((SCENE / 'scene.json').read_text())
    scene['clusters'] = [dict(scene['clusters'][0], name=name)]
    scene.update(changes)
    shutil.copytree(SCENE / 'sparse', folder / 'sparse')
    (folder / 'images').mkdir()
    for image in (SCENE / 'images').glob('cluster1_*'):
        shutil.copy(image, folder / 'images')
    path = folder / 'scene.json'
    path.write_text(json.dumps(scene))
    return path


def knows_localhost():
    """An unpacked base system without /etc/hosts does not, and chromedriver cannot do without."""
    try:
        return bool(socket.gethostbyname('localhost'))
    except OSError:
        return False


@unittest.skipUnless(DRIVER, 'chromium-driver and python3-selenium are not installed')
@unittest.skipUnless(knows_localhost(), "the name 'localhost' is not known here")
class TestPage(unittest.TestCase):
    """The page of the example scene, as a browser without a network shows it."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        truth = cls.folder / 'truth.ply'
        result = run('report', SCENE / 'scene.json', '-o', cls.folder / 'report', '--cells', 96,
                     '--viewer-triangles', 20000)
        assert result.returncode == 0, result.stderr
        # The surface itself as the truth: its figures are known.
        shutil.copy(cls.folder / 'report' / 'mesh.ply', truth)
        result = run('report', SCENE / 'scene.json', '-o', cls.folder / 'report', '--cells', 96,
                     '--viewer-triangles', 20000, '--truth', truth)
        assert result.returncode == 0, result.stderr
        cls.page = cls.folder / 'report' / 'index.html'
        cls.log = result.stderr
        cls.browser = cls.start_browser()
        cls.addClassCleanup(cls.browser.quit)

    @classmethod
    def start_browser(cls, *more):
        options = Options()
        for flag in ('--headless=new', '--disable-dev-shm-usage', '--use-angle=swiftshader',
                     '--enable-unsafe-swiftshader', '--disable-background-networking', '--window-size=1280,1000',
                     f'--user-data-dir={tempfile.mkdtemp(dir=cls.folder)}', *more):
            options.add_argument(flag)
        if os.geteuid() == 0:
            options.add_argument('--no-sandbox')   # chromium refuses to run for root with it
        options.set_capability('goog:loggingPrefs', {'browser': 'ALL', 'performance': 'ALL'})
        return webdriver.Chrome(options=options, service=Service(DRIVER))

    def open(self, browser=None, width=1280):
        browser = browser or self.browser
        browser.execute_cdp_cmd('Emulation.setDeviceMetricsOverride',
                                {'width': width, 'height': 900, 'deviceScaleFactor': 1, 'mobile': width < 600})
        browser.get_log('browser'), browser.get_log('performance')   # what was before
        browser.get(self.page.as_uri())
        return browser

    def open_model(self, width=1280):
        browser = self.open(width=width)
        for _ in range(300):
            if browser.execute_script("return document.getElementById('view').dataset.ready"):
                break
            time.sleep(0.1)
        canvas = browser.find_element(By.ID, 'view')
        browser.execute_script('arguments[0].scrollIntoView({block: "center", behavior: "instant"})', canvas)
        return canvas

    def shown(self, canvas):
        time.sleep(0.5)   # the next frame
        return pixels(canvas.screenshot_as_png)

    def script(self, text):
        return self.browser.execute_script(text)

    def test_console_is_silent_and_nothing_is_fetched(self):
        self.open_model()
        self.assertEqual(self.browser.get_log('browser'), [])
        events = [json.loads(entry['message'])['message'] for entry in self.browser.get_log('performance')]
        urls = [event['params']['request']['url'] for event in events
                if event['method'] == 'Network.requestWillBeSent']
        others = [url for url in urls if url != self.page.as_uri() and not url.startswith('data:')]
        self.assertIn(self.page.as_uri(), urls)
        self.assertEqual(others, [])

    def test_page_is_of_one_file_and_not_large(self):
        text = self.page.read_text()
        self.assertLess(len(text), 15e6)
        sources = re.findall(r'(?:src|href)="([^"]{1,40})', text)
        self.assertGreater(len(sources), 10)
        for source in sources:
            self.assertRegex(source, r'^(data:|#)')

    def test_every_section_is_there(self):
        self.open()
        for section in ('model', 'features', 'cameras', 'cloud', 'surface', 'textured', 'numbers', 'truth', 'commands'):
            with self.subTest(section=section):
                height = self.script(f"return document.getElementById('{section}').getBoundingClientRect().height")
                self.assertGreater(height, 80)
        self.assertEqual(self.script("return document.querySelectorAll('h1').length"), 1)
        for link in self.script("return [...document.querySelectorAll('nav a')].map(a => a.getAttribute('href'))"):
            self.assertIsNotNone(self.script(f"return document.querySelector('{link}')"), link)

    def test_every_picture_is_shown_and_told(self):
        self.open()
        pictures = self.script('return [...document.images].map(i => [i.naturalWidth, i.naturalHeight, i.alt,'
                               ' i.getAttribute("width"), i.getAttribute("height")])')
        self.assertEqual(len(pictures), 2 * CLUSTERS + 6)
        for natural_width, natural_height, alt, width, height in pictures:
            self.assertGreater(natural_width, 300)
            self.assertEqual([natural_width, natural_height], [int(width), int(height)])
            self.assertGreater(len(alt), 10)
        self.assertEqual(len({alt for _, _, alt, _, _ in pictures}), len(pictures), 'each is told otherwise')

    def test_cameras_are_drawn(self):
        self.open()
        self.assertEqual(self.script("return document.querySelectorAll('svg .reference').length"), CLUSTERS)
        self.assertEqual(self.script("return document.querySelectorAll('svg .camera').length"), 2 * 5 * CLUSTERS)

    def test_model_is_drawn_and_turned(self):
        canvas = self.open_model()
        before = self.shown(canvas)
        self.assertGreater(before.std(), 30, 'blank')
        ActionChains(self.browser).move_to_element(canvas).click_and_hold().move_by_offset(120, 40).release().perform()
        turned = self.shown(canvas)
        self.assertGreater(np.abs(turned - before).mean(), 10)
        self.browser.find_element(By.CSS_SELECTOR, '[data-show=reset]').click()
        again = self.shown(canvas)
        self.assertLess(np.abs(again - before).mean(), 1, 'reset')
        canvas.send_keys(Keys.ARROW_LEFT)
        self.assertGreater(np.abs(self.shown(canvas) - before).mean(), 5, 'by the keyboard')

    def test_wheel_comes_nearer_without_scrolling(self):
        canvas = self.open_model()
        before, at = self.shown(canvas), self.script('return scrollY')
        ActionChains(self.browser).scroll_from_origin(
            webdriver.common.actions.wheel_input.ScrollOrigin.from_element(canvas), 0, -300).perform()
        self.assertGreater(np.abs(self.shown(canvas) - before).mean(), 5)
        self.assertEqual(self.script('return scrollY'), at)

    def test_buttons_change_what_is_shown(self):
        canvas = self.open_model()
        before = self.shown(canvas)
        for what in ('textured', 'points', 'cameras'):
            with self.subTest(what=what):
                button = self.browser.find_element(By.CSS_SELECTOR, f'[data-show={what}]')
                pressed = button.get_attribute('aria-pressed')
                button.click()
                self.assertNotEqual(button.get_attribute('aria-pressed'), pressed)
                if what == 'cameras':   # they are behind the viewpoint: step back
                    for _ in range(12):
                        canvas.send_keys('-')
                    with_cameras = self.shown(canvas)
                    button.click()
                    self.assertGreater((np.abs(self.shown(canvas) - with_cameras).max(axis=2) > 40).sum(), 200)
                else:
                    after = self.shown(canvas)
                    self.assertGreater(np.abs(after - before).mean(), 1)
                    before = after

    def test_touch_turns_the_model(self):
        canvas = self.open_model(width=400)
        before = self.shown(canvas)
        place = canvas.rect
        x, y = self.script('const r = document.getElementById("view").getBoundingClientRect();'
                           'return [r.x + r.width / 2, r.y + r.height / 2]')
        for kind, dx in (('touchStart', 0), ('touchMove', 40), ('touchMove', 80), ('touchEnd', None)):
            points = [] if dx is None else [{'x': x + dx, 'y': y}]
            self.browser.execute_cdp_cmd('Input.dispatchTouchEvent', {'type': kind, 'touchPoints': points})
        self.assertGreater(np.abs(self.shown(canvas) - before).mean(), 5, place)

    def test_narrow_page_does_not_scroll_sideways(self):
        self.open(width=400)
        self.assertEqual(self.script('return innerWidth'), 400)
        self.assertLessEqual(self.script('return document.documentElement.scrollWidth'), 400)
        sizes = self.script('return [...document.querySelectorAll("p, figcaption, td")].map('
                            'e => parseFloat(getComputedStyle(e).fontSize))')
        self.assertGreaterEqual(min(sizes), 12)

    def test_light_and_dark(self):
        self.open()
        brightness = {}
        for scheme in ('light', 'dark'):
            self.browser.execute_cdp_cmd(
                'Emulation.setEmulatedMedia', {'features': [{'name': 'prefers-color-scheme', 'value': scheme}]})
            colors = self.script('const s = getComputedStyle(document.body); return [s.color, s.backgroundColor]')
            ink, ground = (sum(map(int, re.findall(r'\d+', color)[:3])) for color in colors)
            brightness[scheme] = ground
            self.assertGreater(abs(ink - ground), 450, scheme)
        self.assertGreater(brightness['light'], brightness['dark'] + 450)

    def test_numbers_are_those_of_the_run(self):
        self.open()
        text = self.script('return document.body.innerText')
        with open(self.folder / 'report' / 'mesh.ply', 'rb') as mesh:
            triangles = int(re.search(rb'element face (\d+)', mesh.read(1000))[1])
        self.assertIn(f'{triangles:,}', text)
        rows = self.script('return [...document.querySelectorAll("#numbers table")].map(t =>'
                           ' [...t.rows].map(r => [...r.cells].map(c => c.innerText)))')
        views = rows[0]
        self.assertEqual([row[0] for row in views[1:-1]], [f'cluster{i + 1}' for i in range(CLUSTERS)])
        for column in range(1, 6):
            counts = [int(row[column].replace(',', '')) for row in views[1:]]
            self.assertEqual(sum(counts[:-1]), counts[-1])
            self.assertGreater(min(counts), 0)
        self.assertIn('in an earlier run', [row[2] for row in rows[-1]])

    def test_figures_against_itself_are_perfect(self):
        self.open()
        rows = self.script('return [...document.querySelectorAll("#truth tbody tr")].map('
                           'r => [...r.cells].map(c => c.innerText))')
        self.assertEqual([row[0] for row in rows], ['Rays', 'Accuracy', 'Completeness', 'F-score'])
        for row in rows:
            self.assertEqual(row[1:], ['100.0 %'] * 3)

    def test_commands_repeat_the_run(self):
        self.open()
        commands = self.script('return [...document.querySelectorAll("#commands pre")].map(p => p.innerText)')
        self.assertIn('--cells 96', commands[0])
        self.assertIn('--viewer-triangles 20000', commands[0])
        again = self.folder / 'again.ply'
        line = commands[1].replace(str(self.folder / 'report' / 'mesh.ply'), str(again))
        environment = dict(os.environ, PATH=f'{Path(PROGRAM).parent}:{os.environ["PATH"]}')
        subprocess.run(line, shell=True, check=True, env=environment, capture_output=True, timeout=300)
        self.assertEqual(again.read_bytes(), (self.folder / 'report' / 'mesh.ply').read_bytes())

    def test_without_webgl_a_sentence_stands_there(self):
        browser = self.start_browser('--disable-3d-apis')
        try:
            self.open(browser)
            self.assertIn('WebGL', browser.find_element(By.ID, 'viewer-missing').text)
            self.assertFalse(browser.find_element(By.ID, 'view').is_displayed())
            errors = [entry for entry in browser.get_log('browser') if entry['source'] == 'javascript']
            self.assertEqual(errors, [])
        finally:
            browser.quit()


class WithFolder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix='freespace-test-'))
        self.addCleanup(shutil.rmtree, self.folder)

    def report(self, *arguments):
        result = run('report', *arguments, '--viewer-triangles', 2000, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stderr


class TestTakingUp(WithFolder):
    def made(self, log):
        return [stage for stage in ('stereo', 'triangulate', 'contour') if f'{stage}: done' in log]

    def test_only_what_changed_is_made_anew(self):
        small_scene(self.folder)
        fast = ('scene.json', '-o', 'out', '--cells', '24')
        self.assertEqual(self.made(self.report(*fast)), ['stereo', 'triangulate', 'contour'])
        self.assertEqual(self.made(self.report(*fast)), [])
        self.assertEqual(self.made(self.report('scene.json', '-o', 'out', '--cells', '20')), ['contour'])
        self.assertEqual(self.made(self.report('scene.json', '-o', 'out', '--cells', '20', '--tolerance', '0.001')),
                         ['triangulate', 'contour'])
        os.utime(self.folder / 'images' / 'cluster1_l.jpg')
        self.assertEqual(self.made(self.report(*fast)), ['stereo', 'triangulate', 'contour'])
        self.assertEqual(self.made(self.report(*fast, '--fresh')), ['stereo', 'triangulate', 'contour'])

    def test_given_files_take_a_stages_place(self):
        small_scene(self.folder)
        for command in (('stereo', 'scene.json', '-o', 'features.vtm'),
                        ('triangulate', 'features.vtm', '-o', 'maps.vtm'),
                        ('contour', 'maps.vtm', '-o', 'my mesh.ply', '--cells', 24)):
            self.assertEqual(run(*command, cwd=self.folder).returncode, 0)
        log = self.report('scene.json', '-o', 'out', '--features', 'features.vtm', '--maps', 'maps.vtm',
                          '--mesh', 'my mesh.ply')
        self.assertEqual(self.made(log), [])
        self.assertEqual(sorted(os.listdir(self.folder / 'out')), ['figures', 'index.html'])
        page = (self.folder / 'out' / 'index.html').read_text()
        self.assertIn('--mesh &#39;my mesh.ply&#39;', page)

    def test_another_given_file_is_another_input(self):
        small_scene(self.folder)
        self.assertEqual(run('stereo', 'scene.json', '-o', 'features.vtm', cwd=self.folder).returncode, 0)
        fast = ('scene.json', '-o', 'out', '--cells', '24')
        self.report(*fast)   # newer than features.vtm, and from other features
        self.assertEqual(self.made(self.report(*fast, '--features', 'features.vtm')), ['triangulate', 'contour'])

    def test_photographs_that_were_not_kept(self):
        small_scene(self.folder)
        self.assertEqual(run('stereo', 'scene.json', '-o', 'features.vtm', cwd=self.folder).returncode, 0)
        (self.folder / 'images' / 'cluster1_c.jpg').unlink()
        self.report('scene.json', '-o', 'out', '--cells', '24', '--features', 'features.vtm')
        self.assertIn('id="features"', (self.folder / 'out' / 'index.html').read_text())

    def test_odd_names_are_harmless(self):
        small_scene(self.folder, name='<b>"one" & \'two\'')
        self.report('scene.json', '-o', 'out & more', '--cells', '24')
        page = (self.folder / 'out & more' / 'index.html').read_text()
        self.assertNotIn('<b>"one"', page)
        self.assertIn('&lt;b&gt;&quot;one&quot; &amp; &#39;two&#39;', page)
        self.assertIn('-o &#39;out &amp; more&#39;', page)

    def test_scene_without_clusters(self):
        shutil.copytree(SCENE / 'images', self.folder / 'images')
        shutil.copytree(SCENE / 'sparse', self.folder / 'sparse')
        (self.folder / 'scene.json').write_text('{"images": "images", "model": "sparse"}')
        self.report('scene.json', '-o', 'out', '--cells', '24')
        self.assertIn('30 cameras in 1 clusters', (self.folder / 'out' / 'index.html').read_text())


class TestModel(WithFolder):
    """A structure-from-motion model in place of a scene.json."""

    def make_model(self):
        """Cluster1's cameras, and what the stereo finds there as points that all of its images observe."""
        small_scene(self.folder)
        for command in (('stereo', 'scene.json', '-o', 'features.vtm', '--every-image', 'off'),
                        ('export', 'features.vtm', '-o', 'points.csv')):
            self.assertEqual(run(*command, cwd=self.folder).returncode, 0)
        table = np.genfromtxt(self.folder / 'points.csv', delimiter=',', names=True)[::3]
        points = np.stack([table[axis] for axis in 'xyz'], axis=1)
        lines = [line for line in (self.folder / 'sparse' / 'images.txt').read_text().splitlines()
                 if line.endswith('.jpg') and 'cluster1_' in line]
        lens = [float(word) for word in (self.folder / 'sparse' / 'cameras.txt').read_text().split('PINHOLE')[1].split()[2:6]]
        images, tracks = [], [[] for _ in points]
        for line in lines:
            w, x, y, z, *t = map(float, line.split()[1:8])
            rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                                 [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                                 [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
            seen = points @ rotation.T + t
            pixels = seen[:, :2] / seen[:, 2:] * lens[:2] + lens[2:]
            images += [line, ' '.join(f'{u} {v} {i + 1}' for i, (u, v) in enumerate(pixels))]
            for i, track in enumerate(tracks):
                track.append(f'{line.split()[0]} {i}')
        model = self.folder / 'model'
        model.mkdir()
        shutil.copy(self.folder / 'sparse' / 'cameras.txt', model)
        (model / 'images.txt').write_text('\n'.join(images) + '\n')
        (model / 'points3D.txt').write_text(''.join(
            f'{i + 1} {x} {y} {z} 128 128 128 0.1 {" ".join(track)}\n'
            for i, ((x, y, z), track) in enumerate(zip(points, tracks))))

    def test_points_and_densified(self):
        self.make_model()
        log = self.report('model', '-o', 'out', '--cells', '24')
        self.assertIn('sparse: done', log)
        page = (self.folder / 'out' / 'index.html').read_text()
        self.assertIn('<title>model', page)
        self.assertIn('freespace sparse model -o', page)
        self.assertIn('region (--region)', page)
        scene = json.loads((self.folder / 'out' / 'scene.json').read_text())
        self.assertTrue(os.path.samefile(self.folder / 'out' / scene['model'], self.folder / 'model'))
        self.assertTrue(os.path.samefile(self.folder / 'out' / scene['images'], self.folder / 'images'))
        self.assertNotIn('sparse: done', self.report('model', '-o', 'out', '--cells', '24'))
        log = self.report('model', '-o', 'out', '--cells', '24', '--densify', 'images')
        self.assertIn('stereo: done', log)
        page = (self.folder / 'out' / 'index.html').read_text()
        self.assertNotIn('freespace sparse model -o', page)
        self.assertIn('cameras (--refine-cameras)', page)


class TestBadInput(WithFolder):
    def fails(self, mentions, *arguments):
        before = sorted(path for path in self.folder.rglob('*'))
        result = run('report', *arguments, cwd=self.folder)
        self.assertGreater(result.returncode, 0, result.stderr)
        lines = [line for line in result.stderr.splitlines() if line.startswith('freespace: ')]
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertIn(mentions, lines[0])
        self.assertEqual(sorted(path for path in self.folder.rglob('*')), before, 'something half-written is left')

    def test_missing_scene(self):
        self.fails('none.json', 'none.json', '-o', 'out')

    def test_scene_that_is_none(self):
        (self.folder / 'scene.json').write_text('{')
        self.fails('scene.json', 'scene.json', '-o', 'out')

    def test_model_without_points(self):
        small_scene(self.folder)
        self.fails('sparse', 'sparse', '-o', 'out')

    def test_model_without_its_images(self):
        small_scene(self.folder)
        (self.folder / 'elsewhere').mkdir()
        self.fails('elsewhere', 'sparse', '-o', 'out', '--images', 'elsewhere')

    def test_options_of_models_for_a_scene(self):
        small_scene(self.folder)
        self.fails('scene.json', 'scene.json', '-o', 'out', '--densify', 'images')

    def test_missing_photograph(self):
        small_scene(self.folder)
        (self.folder / 'images' / 'cluster1_r.jpg').unlink()
        self.fails('cluster1_r.jpg', 'scene.json', '-o', 'out')

    def test_output_that_is_a_file(self):
        small_scene(self.folder)
        (self.folder / 'out').write_text('precious')
        self.fails('out', 'scene.json', '-o', 'out')
        self.assertEqual((self.folder / 'out').read_text(), 'precious')

    def test_output_within_a_file(self):
        small_scene(self.folder)
        (self.folder / 'file').write_text('precious')
        self.fails('file/out', 'scene.json', '-o', 'file/out')

    def test_given_files_that_are_none(self):
        small_scene(self.folder)
        (self.folder / 'empty.vtm').write_text('')
        for option in ('--features', '--maps'):
            for name in ('none.vtm', 'empty.vtm'):
                with self.subTest(option=option, name=name):
                    self.fails(name, 'scene.json', '-o', 'out', '--features', name)
        self.fails('none.ply', 'scene.json', '-o', 'out', '--truth', 'none.ply')
        self.fails('none.ply', 'scene.json', '-o', 'out', '--mesh', 'none.ply')


if __name__ == '__main__':
    unittest.main()
