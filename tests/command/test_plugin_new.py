"""plugin new: what it writes and what it refuses. That this builds and runs is for tests/out_of_tree.sh."""

import os
import subprocess
import unittest

from support import PROJECT, CommandTest

KINDS = ("kernel", "boundary", "shape", "physics", "observer")


class PluginNew(CommandTest):
    def refused(self, *arguments):
        _, err = self.mesogen("plugin", "new", *arguments, code=2)
        return err

    def test_writes_source_test_and_build_file(self):
        for kind in KINDS:
            out, err = self.mesogen("plugin", "new", kind, f"my_{kind}")
            self.assertEqual(err, "")
            self.assertEqual(sorted(os.listdir(self.path(f"my_{kind}"))),
                             ["CMakeLists.txt", f"my_{kind}.cpp", f"test_my_{kind}.cpp"])
            self.assertIn(f'"my_{kind}", "1.0.0"', self.read(f"my_{kind}", f"my_{kind}.cpp"))
            self.assertIn(f"class My{kind.capitalize()}Plugin final", self.read(f"my_{kind}", f"my_{kind}.cpp"))
            build = self.read(f"my_{kind}", "CMakeLists.txt")
            self.assertIn(f"mesogen_add_plugin(NAME my_{kind} KIND {kind} ", build)
            for name in os.listdir(self.path(f"my_{kind}")):
                self.assertNotRegex(self.read(f"my_{kind}", name), "(?i)template_?(name|kind)")
            self.assertIn(f"cmake -S my_{kind} -B my_{kind}/build -DCMAKE_PREFIX_PATH=", out)
            self.assertIn(f"export MESOGEN_PLUGIN_PATH={os.path.realpath(self.folder)}/my_{kind}/build/plugins"
                          "${MESOGEN_PLUGIN_PATH:+:$MESOGEN_PLUGIN_PATH}\n", out)
            key = {"boundary": "boundary", "shape": "shape"}.get(kind, "type")
            self.assertIn(f'{key} = "my_{kind}"', out)

    def test_writes_into_the_folder_that_is_named(self):
        os.mkdir(self.path("empty"))
        for folder in ("empty", "a/b c/d"):
            self.mesogen("plugin", "new", "kernel", "narrow", folder)
            self.assertTrue(os.path.exists(self.path(folder, "narrow.cpp")))

    def test_initial_condition_called_like_a_section(self):
        for name, why in (("physics", 'taken: "physics"'), ("domains", 'too near to "domain"'), ("title", 'taken: "title"')):
            _, err = self.mesogen("plugin", "new", "initial", name, code=2)
            self.assertIn(f'"{name}" is {why}, a section or key of Mesogen\'s own: take another name', err)
            self.assertFalse(os.path.exists(self.path(name)))

    def test_unknown_kind(self):
        self.assertIn('"physic" is no kind of plugin (there are: kernel, boundary, shape, initial, physics, observer); did you mean '
                      '"physics"?', self.refused("physic", "my_force"))

    def test_names_that_cannot_be(self):
        for name in ("MyForce", "my-force", "2nd_force", "_force", "force_", "my__force", "kräfte", "a/b", "../force"):
            self.assertIn(f'"{name}" cannot be the name of a plugin: use small letters and digits, with single '
                          "underscores between them, and begin with a letter, such as my_force", self.refused("physics", name))
        self.assertIn("a plugin needs a name, such as my_force", self.refused("physics", ""))
        self.assertIn('"double" cannot be the name of a plugin: it is a word of C++; take another, such as my_double',
                      self.refused("physics", "double"))
        self.assertIn('"test" cannot be the name of a plugin: builds have a target of this name; take another, such as '
                      "my_test", self.refused("physics", "test"))
        for name in ("mesogen", "mesogen_options"):
            self.assertIn(f'"{name}" cannot be the name of a plugin: a build target of Mesogen has this name; take '
                          "another, such as my_plugin", self.refused("physics", name))
        self.assertIn("builds have a target of this name", self.refused("physics", "programs"))
        self.assertEqual(os.listdir(self.folder), [])

    def test_names_that_are_words_of_mesogen_compile(self):
        headers = [f"-I{os.path.join(PROJECT, part, 'include')}" for part in ("framework", "testing")]
        for kind, name in (("boundary", "boundary"), ("physics", "add_force"), ("physics", "index"),
                           ("observer", "by_id"), ("kernel", "kernel")):
            folder = f"{kind}_{name}"
            self.mesogen("plugin", "new", kind, name, folder)
            for file in (f"{name}.cpp", f"test_{name}.cpp"):
                done = subprocess.run(["c++", "-std=c++20", "-fsyntax-only", "-fopenmp", "-Wall", "-Wextra", "-Wshadow",
                                       "-Werror", *headers, self.path(folder, file)], text=True,
                                      capture_output=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                if name != "boundary":
                    break  # tests name their plugin in texts alone: one is enough

    def test_folder_that_holds_something(self):
        self.mesogen("plugin", "new", "kernel", "narrow")
        self.assertIn("the folder narrow is there already and not empty: name another, or remove it",
                      self.refused("kernel", "narrow"))

    def test_folder_that_is_a_file(self):
        self.write_case()
        self.assertIn("case.toml is there already and is no folder: name another",
                      self.refused("kernel", "narrow", "case.toml"))

    def test_folder_that_cannot_be_made(self):
        self.write_case()
        _, err = self.mesogen("plugin", "new", "kernel", "narrow", "case.toml/narrow", code=1)
        self.assertIn("the folder case.toml/narrow cannot be made (", err)

    def test_name_that_is_taken(self):
        _, err = self.mesogen("plugin", "new", "kernel", "quintic")
        self.assertRegex(err, r'warning: there is already a plugin of the kind kernel called "quintic", /.*quintic\.so: the two cannot be '
                              "loaded together; take another name, or remove that one")
        _, err = self.mesogen("plugin", "new", "observer", "quintic", "other")
        self.assertEqual(err, "", "a name may be used once a kind")


if __name__ == "__main__":
    unittest.main()
