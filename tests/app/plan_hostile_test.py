"""Plans that are truncated, huge, of another version, or not what anybody's `plan` wrote: one line each, nothing written."""

import json

from pictures import scene
from plans import TINY, Plans
from support import main


class Hostile(Plans):
    def setUp(self):
        super().setUp()
        self.make("compare", scene("steps"), "--technique", "hard", *TINY, "--spp", "8", "--no-cost")
        self.good = self.plan.read_text()

    def refused(self, text):
        self.plan.write_text(text)
        errors = {self.refuse("work", self.plan), self.refuse("plan", "show", self.plan),
                  self.refuse("merge", self.plan, "-o", self.folder / "report")}
        for error in errors:
            self.assertIn(f"'{self.plan}'", error)
        self.assertEqual(list(self.folder.iterdir()), [self.plan])
        return errors

    def changed(self, change):
        document = json.loads(self.good)
        change(document)
        return json.dumps(document)

    def test_broken_text(self):
        for text in ("", "{", self.good[: len(self.good) // 2], self.good.replace("compare", "comp\0are", 1), "[]", "3",
                     "null", "NaN", self.good.replace('"seconds":', '"seconds":NaN,"x":'), "[" * 100_000,
                     '{"items":' + "[" * 100_000, self.good.replace('"seconds":', '"seconds":1e999,"x":')):
            with self.subTest(text[:40]):
                self.refused(text)

    def test_deep_nesting(self):
        deep = "[" * 300_000 + "]" * 300_000
        objects = '{"a":' * 300_000 + "1" + "}" * 300_000
        for text in (deep, objects, self.good.replace('"items": [', f'"more": {deep}, "items": [', 1),
                     self.good.replace('"seconds":', f'"more":{objects},"seconds":', 1)):
            self.assertNotEqual(text, self.good)
            for error in self.refused(text):
                self.assertIn("nested more than 64 deep", error)

    def test_wrong_values(self):
        def put(*path, value):
            def change(document):
                for name in path[:-1]:
                    document = document[name]
                document[path[-1]] = value
            return change

        def of_another_format(document):
            document["format"] = "penumbra.plan/2"
            document["items"][0].pop("key")

        for error in self.refused(self.changed(of_another_format)):
            self.assertIn("its format is", error)
        for change in (put("format", value="penumbra.plan/2"), put("format", value=3), put("version", value="Penumbra 9"),
                       put("commit", value="abc"), put("build", value="0" * 32), put("build", value=[]),
                       put("arguments", value="x"), put("arguments", value=[]), put("arguments", value=[None, None]),
                       put("arguments", value=[1, None]), put("scenes", value={}), put("items", value=None),
                       put("items", value=[]), put("items", value=[3]), put("items", value={}),
                       put("items", 0, "key", value="../../../../tmp/x"), put("items", 0, "key", value="A" * 32),
                       put("items", 0, "scene", value=1), put("items", 0, "scene", value=-1),
                       put("items", 0, "scene", value=10**30), put("items", 0, "seconds", value="1"),
                       put("items", 0, "seconds", value=-1), put("scenes", 0, "files", 0, "bytes", value=-1),
                       put("scenes", 0, "files", 0, "hash", value=None), put("scenes", 0, "files", 0, "shader", value=3),
                       put("scenes", 0, "files", 0, value=3), put("scenes", 0, "path", value=[])):
            with self.subTest(change):
                self.refused(self.changed(change))

    def test_another_version_is_one_line(self):
        for error in self.refused(self.changed(lambda plan: plan.update(version="Penumbra 0.0.1"))):
            self.assertIn("Penumbra 0.0.1, commit ", error)
            self.assertIn("plan again", error)

    def fails_at_work(self, change):
        self.plan.write_text(self.changed(change))
        error = self.refuse("work", self.plan)
        self.assertFalse((self.folder / "sweep.results").exists())
        return error

    def test_other_arguments_than_planned(self):
        self.assertIn("--techniqe", *self.refused(self.changed(lambda plan: plan["arguments"].insert(0, "--techniqe"))))
        self.refused(self.changed(lambda plan: plan["arguments"].insert(0, "--help")))
        self.refused(self.changed(lambda plan: plan.update(command="doctor")))
        self.refused(self.changed(lambda plan: plan["items"].append(dict(plan["items"][0]))))
        self.assertIn("plan again", self.fails_at_work(lambda plan: plan["arguments"].extend(["--sun-angle", "3"])))
        self.assertIn("plan again", self.fails_at_work(lambda plan: plan["items"][0].update(key="0" * 32)))

    def test_other_files_than_planned(self):
        files = self.document()["scenes"][0]["files"][0]
        self.assertIn("plan again", self.fails_at_work(
            lambda plan: plan["scenes"][0]["files"].append(dict(files, path=str(scene("steps"))))))
        for path in ("/etc/shadow", "/dev/zero", "/nowhere", "/"):
            self.fails_at_work(lambda plan: plan["scenes"][0]["files"][0].update(path=path))

    def test_a_plan_that_is_no_file(self):
        for path in (self.folder, self.folder / "nothing.json", "/dev/zero"):
            self.assertIn("cannot use the plan", self.refuse("work", path))

    def test_a_plan_of_very_many_items(self):
        document = json.loads(self.good)
        item = json.dumps(document["items"][0])
        document["items"] = []
        begin = json.dumps(document)[:-3] + "["
        with open(self.plan, "w", encoding="utf-8") as file:
            file.write(begin + ",".join([item] * 1_000_001) + "]}")
        self.assertIn("more than 1000000 items", self.refuse("plan", "show", self.plan))


if __name__ == "__main__":
    main()
