"""Adds up the cases of test runs: one line of run, passed, failed and skipped."""

import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def cases_of(file):
    """(run, failed, skipped) of one entry of ctest, from the report that the test program wrote."""
    run = failed = skipped = 0
    for case in ElementTree.parse(file).iter("testcase"):
        if case.get("status") == "notrun":
            continue
        run += 1
        failed += case.find("failure") is not None
        skipped += case.find("skipped") is not None
    return run, failed, skipped


def count(folder):
    totals = [0, 0, 0]
    if not (folder / "ctest.xml").exists():  # ctest ended before it could write it
        return [1, 1, 0]
    for entry in ElementTree.parse(folder / "ctest.xml").iter("testcase"):
        report = folder / (entry.get("name").replace("/", ".") + ".xml")
        entry_failed = entry.get("status") == "fail"
        cases = cases_of(report) if report.exists() else (1, 0, int(entry.get("status") == "notrun"))
        if entry_failed and cases[1] == 0:  # it crashed or ran out of time
            cases = (max(cases[0], 1), 1, cases[2])
        totals = [total + new for total, new in zip(totals, cases)]
    return totals


def main():
    totals = [count(pathlib.Path(folder)) for folder in sys.argv[1:]]
    run, failed, skipped = map(sum, zip(*totals))
    print(f"tests: {run} run, {run - failed - skipped} passed, {failed} failed, {skipped} skipped")


if __name__ == "__main__":
    main()
