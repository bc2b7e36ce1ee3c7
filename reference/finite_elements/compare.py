"""Computed histories against the stored ones, column by column, near wave fronts and away from them."""

from dataclasses import dataclass

import numpy as np

# Largest difference allowed away from fronts, over the peak of the stored column.
ALLOWED = 0.005
# A row is near a front when, within half a rise of it, smoothing moves the stored history by more than that.
FRONT = ALLOWED


@dataclass(frozen=True)
class Difference:
    """Of one column, over the peak of the stored smoothed one: everywhere and away from fronts (`far`)."""

    column: str
    largest: float
    rms: float
    largest_far: float
    rms_far: float
    judged: float

    @property
    def holds(self):
        """False for NaN too."""
        return self.judged <= ALLOWED

    def __str__(self):
        percent = [f"{100 * share:6.3f}" for share in (self.largest, self.rms, self.largest_far, self.rms_far)]
        return f"{'pass' if self.holds else 'FAIL'} {' '.join(percent)}  {self.column}"


def read(path, header):
    """Rows (samples, columns) of a history with this header line."""
    with open(path, encoding="ascii") as file:
        found = file.readline().rstrip("\n")
        if found != header:
            raise ValueError(f"{path}: the columns are\n  {found}\nand should be\n  {header}")
        return np.loadtxt(file, delimiter=",", ndmin=2)


def near_fronts(times, raw, smooth, rise):
    """Which rows lie within half a rise of one where raw and smooth differ by more than FRONT of the peak."""
    fronts = times[np.abs(raw - smooth) > FRONT * np.abs(smooth).max()]
    distance = np.abs(times[:, None] - fronts[None, :]).min(axis=1, initial=np.inf)
    return distance <= 0.5 * rise


def differences(plate, stored, computed):
    """One Difference per history of the tables (samples, columns): time, then raw, smoothed and error of each load.

    Smoothed columns are judged by their largest difference away from fronts. A raw column rings in every mesh before
    and after a front, the stored ones by up to 1 % of the peak where the answer is 0: it is judged by the root of the
    mean square.
    """
    if stored.shape != computed.shape or not np.allclose(stored[:, 0], computed[:, 0], rtol=1e-4, atol=0.0):
        raise ValueError(f"{plate.file}: the two tables are not at the same instants")
    names = plate.header.split(",")
    found = []
    for first in range(1, stored.shape[1], 3):
        raw, smooth = first, first + 1
        far = ~near_fronts(stored[:, 0], stored[:, raw], stored[:, smooth], plate.rise)
        peak = np.abs(stored[:, smooth]).max()
        for column in (raw, smooth):
            share = np.abs(computed[:, column] - stored[:, column]) / peak
            rms, rms_far = (float(np.sqrt(np.mean(part**2))) for part in (share, share[far]))
            largest_far = float(share[far].max())
            found.append(Difference(f"{names[column]} ({100 * far.mean():.0f} % of the rows away from fronts)",
                                    float(share.max()), rms, largest_far, rms_far,
                                    rms_far if column == raw else largest_far))
    return found
