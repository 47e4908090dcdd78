"""What the scripts of a page work on: columns of numbers, charts of its figures, bundles and the page's policy."""
