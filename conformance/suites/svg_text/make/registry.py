"""The list of cases, which the files of the package `cases` fill."""
from typing import NamedTuple


class Case(NamedTuple):
    name: str  # folder/file
    about: str
    text: str  # the body of the document under test
    paths: str  # that of its picture
    key: str  # regular expression: what the case is about; without it the picture is another one
    without: str  # what stands there then


CASES = []


def case(name, about, text, paths, key, without=""):
    assert all(other.name != name for other in CASES), name
    CASES.append(Case(name, about, text, paths, key, without))
