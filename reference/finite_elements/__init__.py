"""Dynamic stress intensity factors of cracked plates by finite elements: classical elastodynamics, nothing nonlocal."""
