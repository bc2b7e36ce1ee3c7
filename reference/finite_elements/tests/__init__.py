"""Tests of the finite elements against answers that do not share their code."""
