"""The options of the verbs, one file each: read without what carries a verb out, so that completion is quick."""
