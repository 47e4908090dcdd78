"""Writer of sources/buildDescription.xml of FMI 3.0, with which an importer compiles the sources of an FMU."""

from __future__ import annotations

from collections.abc import Sequence

from lxml import etree

from .fmi3 import FMI_VERSION


def build_description(model_identifier: str, source: str, options: Sequence[str]) -> bytes:
    """Return the document for one C file that includes the others, with compiler options for reproducible results."""
    root = etree.Element("fmiBuildDescription", fmiVersion=FMI_VERSION)
    configuration = etree.SubElement(root, "BuildConfiguration", modelIdentifier=model_identifier)
    files = etree.SubElement(
        configuration, "SourceFileSet", language="C99", compiler="gcc", compilerOptions=" ".join(options)
    )
    etree.SubElement(files, "SourceFile", name=source)
    etree.SubElement(configuration, "Library", name="m", external="true", description="the C library's mathematics")
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
