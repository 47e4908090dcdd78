"""Reader of the data embedded in a page for its scripts: the inverse of documents/interactive/columns.py."""

import base64
import json
import zlib

import numpy as np
import pytest
from lxml import html

from perilune.analysis.documents.interactive.embedded import Embedded
from perilune.analysis.documents.interactive.script_bundles import read_bundle


def require_bundle(name):
    """Skip a test where a script was not built, as without npm."""
    if read_bundle(name) is None:
        pytest.skip("no scripts of pages")


def document_of(text):
    """Return the document of a page, or of its elements alone."""
    (content,) = html.document_fromstring(text).xpath("//script[@id='page-data']/text()")
    return json.loads(content)


def embed(name, bundle, content):
    """Embed a document as a page would, and read it back."""
    require_bundle(bundle)
    embedded = Embedded()
    assert embedded.add_document(name, bundle, content)
    return document_of(str(embedded.elements()))


def column(document, index):
    """Return a column of float32."""
    *before, encoded = document["columns"][: index + 1]
    start = sum(4 * each["rows"] for each in before if "low" not in each)
    content = zlib.decompress(base64.b64decode(document["packed"][0]))[start : start + 4 * encoded["rows"]]
    planes = np.frombuffer(content, np.uint8).reshape(4, encoded["rows"])
    folded = np.ascontiguousarray(planes.T).view("<u4")[:, 0]
    numbers = (folded >> 1) ^ (np.uint32(0) - (folded & 1))
    for _ in range(2):
        numbers = np.cumsum(numbers, dtype=np.uint32)
    bits = np.where(numbers >> 31 == 1, numbers & np.uint32(0x7FFFFFFF), ~numbers)
    return bits.astype("<u4").view("<f4").astype(float)
