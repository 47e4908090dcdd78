"""What flies without Python: the loop, the arrays that it works on, its calls of FMUs."""
