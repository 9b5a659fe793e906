"""What the tests of JSON documents share: the schemas in docs/schemas."""

import json

import jsonschema
from support import ROOT, TestCase

SCHEMAS = ROOT / "docs" / "schemas"


def validator(kind):
    return jsonschema.Draft202012Validator(json.loads((SCHEMAS / f"{kind}.json").read_text()))


class SchemaTest(TestCase):
    def check(self, kind, document):
        errors = [f"{error.json_path}: {error.message}" for error in validator(kind).iter_errors(document)]
        self.assertEqual(errors, [], kind)
        self.assertEqual(next(iter(document)), "format")
        # A reader that knows another version must be able to tell.
        self.assertFalse(validator(kind).is_valid({**document, "format": f"penumbra.{kind}/999"}))
