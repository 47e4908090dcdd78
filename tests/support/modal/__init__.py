"""Random plants and spectra for tests of modal synthesis."""
