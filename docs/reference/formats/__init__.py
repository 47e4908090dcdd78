"""Keys of files and of annotations, messages and numbers: each file of this folder is a page of the site."""
