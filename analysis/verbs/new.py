"""`perilune.new_block`, `perilune.new_system` and `perilune new`: templates for a user's blocks and systems."""

from __future__ import annotations

from ..authoring import block_template, system_template
from ..documents.model import Document
from ..documents.of.written_files import new_files_document
from ..options.declared.library import NEW_BLOCK, NEW_SYSTEM
from ..options.verb import verb
from .common.documented import Documented


class NewFiles(Documented, block_template.CreatedFiles):
    """The ``paths`` that were written, and the ``commands`` to run next."""

    def document(self) -> Document:
        """Return a document with the paths and the commands."""
        return new_files_document(self)


@verb(NEW_BLOCK)
def new_block(name: str, slot: str | None = None) -> NewFiles:
    """Write NAME.py with a block into the working folder: `perilune new block`.

    ``slot`` is an interface (of a guidance, filter or allocation) that the block implements. Raises InputError.
    """
    return NewFiles(**vars(block_template.new_block(name, slot)))


@verb(NEW_SYSTEM)
def new_system(name: str) -> NewFiles:
    """Write a folder NAME with a plant, a controller and all files to simulate them: `perilune new system`.

    Raises InputError.
    """
    return NewFiles(**vars(system_template.new_system(name)))
