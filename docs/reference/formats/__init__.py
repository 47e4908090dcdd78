"""Keys of files and annotations, messages and numbers: each TOML file of this folder is a page of the site."""
