"""Studies that choose draws themselves: rare failures, worst cases, sensitivities."""
