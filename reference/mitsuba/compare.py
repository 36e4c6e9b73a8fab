"""Compares the radiance of the reference with that of Mitsuba 3, an independent renderer.

Each scene is rendered several times by both, with different seeds. The film is divided into blocks,
and the means of each block over the seeds are compared with Welch's t-test. The seeds give the
standard errors, so nothing has to be assumed about the noise of either renderer.

See README.md for how to install and run it.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import mitsuba as mi
import numpy as np
from scipy import stats

import mitsuba_scene

ROOT = Path(__file__).resolve().parents[2]
OWN_SCENES = Path(__file__).resolve().parent / "scenes"

# The probability that a scene fails by chance although both renderers agree, for each of the two
# tests.
FALSE_ALARM = 1e-3


def main():
    options = parse_options()
    mi.set_variant("scalar_rgb")
    folders = [ROOT / "scenes", OWN_SCENES]
    scenes = options.scenes or [path for folder in folders for path in sorted(folder.glob("*.json"))]
    print(f"Mitsuba {mi.__version__}: {options.samples} samples per pixel, {options.seeds} seeds, "
          f"{options.bounces} bounces")
    print("| scene | film | blocks | largest z | rms of z | mean ratio | agree |")
    print("|---|---|---|---|---|---|---|")
    verdicts = [compare(path, options) for path in scenes]
    return 0 if all(verdicts) else 1


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", type=Path, help="scene files [default: all]")
    parser.add_argument("--samples", type=int, default=32, help="paths per pixel and seed")
    parser.add_argument("--seeds", type=int, default=16, help="pictures of each renderer")
    parser.add_argument("--bounces", type=int, default=8, help="as in cargo render")
    parser.add_argument("--side", type=int, default=64, help="pixels along the film's longer side")
    parser.add_argument("--block", type=int, default=8, help="pixels along a block's side")
    parser.add_argument("--pictures", type=Path, help="folder for both means of each scene (EXR)")
    return parser.parse_args()


def compare(path, options):
    """Compares one scene, prints a row of the table, and returns whether the renderers agree."""
    with tempfile.TemporaryDirectory() as folder:
        scene = json.loads(path.read_text())
        width, height = scene["camera"]["film"]
        scale = options.side / max(width, height)
        size = max(1, round(width * scale)), max(1, round(height * scale))
        ours = render_ours(path, size, options, Path(folder))
        theirs = render_theirs(scene, path.parent, size, options, Path(folder))
    if options.pictures:
        options.pictures.mkdir(parents=True, exist_ok=True)
        for name, pictures in ("ours", ours), ("mitsuba", theirs):
            mean = pictures.mean(axis=0).astype(np.float32)
            mi.Bitmap(mean).write(str(options.pictures / f"{path.stem}-{name}.exr"))

    blocks = z_scores(block_means(ours, options.block), block_means(theirs, options.block))
    wholes = z_scores(ours.mean(axis=(1, 2)), theirs.mean(axis=(1, 2)))
    agree = all(np.abs(z).max() < limit(z.size) for z in (blocks, wholes))
    ratio = ours.mean() / theirs.mean()
    error = np.hypot(*(relative_error(pictures) for pictures in (ours, theirs)))
    print(f"| `{path.stem}` | {size[0]} × {size[1]} | {blocks.size // 3} | "
          f"{np.abs(blocks).max():.1f} of {limit(blocks.size):.1f} | "
          f"{np.sqrt((blocks ** 2).mean()):.2f} | {ratio:.4f} ± {error:.4f} | "
          f"{'yes' if agree else '**no**'} |", flush=True)
    return agree


def render_ours(path, size, options, folder):
    """Returns the reference's pictures, one for each seed, row by row from the top."""
    def render(seed):
        out = folder / f"{seed}.exr"
        command = ["cargo", "render-reference", path.resolve(), out,
                   "--size", f"{size[0]}x{size[1]}", "--samples", options.samples,
                   "--bounces", options.bounces, "--seed", seed]
        result = subprocess.run(list(map(str, command)), cwd=ROOT, capture_output=True, text=True)
        if result.returncode != 0:
            sys.exit(result.stderr)
        return as_array(mi.Bitmap(str(out)))
    return np.stack([render(seed) for seed in range(options.seeds)])


def render_theirs(scene, folder, size, options, scratch):
    """Returns Mitsuba's pictures in the same form."""
    description = mitsuba_scene.convert(scene, folder, size, options.bounces, scratch)
    scene = mi.load_dict(description)

    def render(seed):
        return as_array(mi.Bitmap(mi.render(scene, spp=options.samples, seed=seed)))
    return np.stack([render(seed) for seed in range(options.seeds)])


def as_array(bitmap):
    return np.array(bitmap, dtype=np.float64)[:, :, :3]


def block_means(pictures, side):
    """Returns the mean of each block of pixels, for each picture and colour channel."""
    def split(array, axis):
        parts = max(1, round(array.shape[axis] / side))
        split = np.array_split(array, parts, axis)
        return np.stack([part.mean(axis=axis) for part in split], axis)
    return split(split(pictures, 1), 2)


def z_scores(ours, theirs):
    """Returns the differences as standard normal variables, if the renderers agree.

    The first axis is that of the seeds. Student's t is converted to the normal variable of the same
    probability.
    """
    with warnings.catch_warnings():
        # Blocks that show only a light or the environment have no noise, and no t.
        warnings.simplefilter("ignore", RuntimeWarning)
        test = stats.ttest_ind(ours, theirs, axis=0, equal_var=False)
    z = np.sign(test.statistic) * stats.norm.isf(test.pvalue / 2)
    # In single precision, such blocks differ by rounding.
    same = np.isclose(ours.mean(axis=0), theirs.mean(axis=0), rtol=1e-4, atol=1e-6)
    return np.where(same, 0, np.where(np.isnan(z), np.inf, z))


def limit(count):
    """Returns the value that the largest of `count` z-scores rarely exceeds (Bonferroni)."""
    return stats.norm.isf(FALSE_ALARM / count / 2)


def relative_error(pictures):
    """Returns the standard error of the mean of all pictures, relative to that mean."""
    means = pictures.mean(axis=(1, 2, 3))
    return stats.sem(means) / means.mean()


if __name__ == "__main__":
    sys.exit(main())
