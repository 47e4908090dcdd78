"""Keys of files and of annotations, messages and numbers: a page of the site for each file of this folder."""
