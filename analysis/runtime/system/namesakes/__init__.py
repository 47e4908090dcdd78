"""Different code of the same name, of which a process can load only one."""
