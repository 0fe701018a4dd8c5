# SPDX-License-Identifier: BSD-3-Clause
"""A full disk, a limit of the size of files and a folder that may not be written: one sentence, and all is as it was."""
import os
import resource
import shutil
import subprocess
import unittest

from outputs import OUTPUTS, PROGRAM, OutputTest, content



def may_mount():
    return shutil.which('unshare') and subprocess.run(
        ['unshare', '--mount', '--map-root-user', 'sh', '-c', 'mount -t tmpfs none /mnt'], capture_output=True).returncode == 0


class TestDisks(OutputTest):
    def expect_refusal(self, name, code, words, old):
        lines = words.splitlines()
        self.assertEqual((code, len(lines)), (1, 1), words)
        self.assertRegex(lines[0], r'^freespace: .*(Cannot write|cannot be written|not writable)')
        self.assertEqual(content(self.folder / name), old)
        self.assertEqual(self.work_folders(), [])

    def test_limits_of_the_size_of_files(self):
        for name, (make_old, make_new) in OUTPUTS.items():
            old = self.made(name)[0]
            self.run_program(make_old)
            before = self.added()
            size = max(path.stat().st_size for path in self.folder.rglob('*') if path.is_file() and not path.is_symlink())
            for limit in sorted({0, 1, size // 4, size // 2}):
                with self.subTest(name=name, limit=limit):
                    done = subprocess.run([PROGRAM, '-q', *make_new], cwd=self.folder, capture_output=True, text=True,
                                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
                    if done.returncode != 0: # the new one may be smaller
                        self.expect_refusal(name, done.returncode, done.stderr, old)
                        self.assertEqual(self.added(), before)
                    else:
                        self.assertGreater(limit, 1)
            for path in self.folder.iterdir():
                if not path.is_symlink():
                    shutil.rmtree(path) if path.is_dir() else path.unlink()

    @unittest.skipUnless(may_mount(), 'no mounts here')
    def test_a_full_disk(self):
        """The disk has room for the old output and a part of the new one."""
        for name, (make_old, make_new) in OUTPUTS.items():
            self.run_program(make_old)
            for room in (4, 16):
                with self.subTest(name=name, room=room):
                    script = ('mkdir -p /tmp/disk && size=$(($(du -sk --apparent-size . | cut -f1) + 400)) && '
                              'mount -t tmpfs -o size=${size}k none /tmp/disk && cp -a . /tmp/disk && cd /tmp/disk && '
                              f'free=$(df -k --output=avail . | tail -1) && dd if=/dev/zero of=fill bs=1k count=$((free - {room})) '
                              'status=none && find . ! -name fill -type f -exec md5sum {} + | sort > /dev/shm/before.$$ && '
                              '"$@"; status=$?; find . ! -name fill -type f -exec md5sum {} + | sort > /dev/shm/after.$$; '
                              'if [ $status = 0 ]; then cmp -s /dev/shm/before.$$ /dev/shm/after.$$ && echo unchanged; '
                              'else cmp /dev/shm/before.$$ /dev/shm/after.$$ || echo changed; find . -name ".freespace-*"; fi; '
                              'rm -f /dev/shm/before.$$ /dev/shm/after.$$; exit $status')
                    done = subprocess.run(['unshare', '--mount', '--map-root-user', 'bash', '-c', script, 'x', PROGRAM, '-q',
                                           *make_new], cwd=self.folder, capture_output=True, text=True)
                    if done.returncode:
                        self.assertEqual(done.returncode, 1, done.stderr)
                        self.assertEqual(done.stdout, '', 'something changed or stayed')
                        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                        self.assertRegex(done.stderr, r'^freespace: .*Cannot write')
                    else:
                        self.assertEqual(done.stdout, '')

    def test_a_folder_that_may_not_be_written(self):
        for name, (make_old, make_new) in OUTPUTS.items():
            self.run_program(make_old)
            old = content(self.folder / name)
            with self.subTest(name=name):
                if os.geteuid() != 0:
                    self.folder.chmod(0o555)
                    code, words = self.run_program(make_new, status=None)
                    self.folder.chmod(0o755)
                elif may_mount():
                    done = subprocess.run(
                        ['unshare', '--mount', 'bash', '-c', 'mount --bind . . && mount -o remount,ro,bind . && cd "$PWD" && "$@"',
                         'x', PROGRAM, '-q', *make_new], cwd=self.folder, capture_output=True, text=True)
                    code, words = done.returncode, done.stderr
                else:
                    self.skipTest('root may write all folders')
                self.expect_refusal(name, code, words, old)


if __name__ == '__main__':
    unittest.main()
