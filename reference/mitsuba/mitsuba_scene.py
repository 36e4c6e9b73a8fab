"""Converts a scene file of this project to a scene for Mitsuba 3.

The format is described in scenes/README.md. Meshes are read here again, so that the comparison
also covers the project's loader.
"""

import mitsuba as mi
import numpy as np


def convert(scene, folder, size, bounces, scratch):
    """Returns a dictionary for `mi.load_dict`. `folder` holds the meshes, and `scratch` receives
    temporary files."""
    converted = {
        "type": "scene",
        # Mitsuba counts the rays of a path, and this project counts where it is scattered.
        "integrator": {"type": "path", "max_depth": bounces + 1, "rr_depth": 1_000_000,
                       "hide_emitters": False},
        "sensor": camera(scene["camera"], size),
    }
    if "environment" in scene:
        converted["environment"] = environment(scene["environment"], folder)
    for number, entry in enumerate(scene["shapes"]):
        [(kind, shape)] = entry.items()
        material = scene["materials"][shape["material"]]
        if kind == "sphere":
            made = sphere(shape)
        else:
            soup = polygon(shape) if kind == "polygon" else mesh(shape, folder)
            if soup[2] is None and "checker" in material:
                raise ValueError("the texture coordinates of this mesh are not converted")
            path = scratch / f"{number}.ply"
            write_ply(path, *soup)
            made = {"type": "ply", "filename": str(path), "face_normals": soup[1] is None}
        converted[f"shape{number}"] = made | surface(material)
    return converted


def environment(entry, folder):
    if isinstance(entry, list):
        return {"type": "constant", "radiance": {"type": "rgb", "value": entry}}
    pixels = np.array(mi.Bitmap(str(folder / entry["map"])).convert(mi.Bitmap.PixelFormat.RGB,
                                                                     mi.Struct.Type.Float32))
    # Mitsuba interpolates between pixels, and this project doesn't. With copies of each pixel, the
    # two hardly differ. Mitsuba's columns begin a quarter of the way further around the y-axis.
    pixels = pixels.repeat(8, axis=0).repeat(8, axis=1) * entry.get("scale", 1.0)
    pixels = np.roll(pixels, pixels.shape[1] // 4, axis=1)
    return {"type": "envmap", "bitmap": mi.Bitmap(pixels.astype(np.float32))}


def camera(entry, size):
    if "aspect_ratio" in entry:
        raise ValueError("a camera with its own aspect ratio has no counterpart in Mitsuba")
    position, look_at = np.array(entry["position"], float), np.array(entry["look_at"], float)
    distance = float(np.linalg.norm(look_at - position))
    return {
        "type": "perspective",
        "fov": entry["vertical_fov"],
        "fov_axis": "y",
        "near_clip": 1e-3 * distance,
        "far_clip": 1e4 * distance,
        "to_world": mi.ScalarTransform4f().look_at(
            origin=entry["position"], target=entry["look_at"], up=entry["up"]),
        "film": {"type": "hdrfilm", "width": size[0], "height": size[1], "pixel_format": "rgb",
                 "component_format": "float32", "rfilter": {"type": "box"}},
        "sampler": {"type": "independent"},
    }


def surface(material):
    """Returns the BSDF and the light of a material, as entries of a shape."""
    [(kind, value)] = material.items()
    if kind == "emitter":
        # The project's lights reflect nothing.
        return {"bsdf": diffuse(rgb([0, 0, 0])),
                "emitter": {"type": "area", "radiance": rgb(value["radiance"])}}
    if kind == "glass":
        return {"bsdf": {"type": "dielectric", "int_ior": value["ior"], "ext_ior": 1.0}}
    if kind == "lambertian":
        bsdf = diffuse(rgb(value["albedo"]))
    elif kind == "checker":
        # Mitsuba's checkerboard has two squares from 0 to 1.
        scale = mi.ScalarTransform3f().scale([value["scale"] / 2, value["scale"] / 2])
        bsdf = diffuse({"type": "checkerboard", "color0": rgb(value["a"]),
                        "color1": rgb(value["b"]), "to_uv": scale})
    elif kind == "mirror":
        bsdf = {"type": "conductor", "material": "none",
                "specular_reflectance": rgb(value["reflectance"])}
    else:
        raise ValueError(f"unknown material {kind}")
    return {"bsdf": {"type": "twosided", "bsdf": bsdf}}


def diffuse(reflectance):
    return {"type": "diffuse", "reflectance": reflectance}


def rgb(value):
    return {"type": "rgb", "value": value}


def sphere(entry):
    # Mitsuba's texture coordinates run around z, with v = 0 at +z. A quarter turn about x makes them
    # run around y, with v = 0 at −y.
    r, (x, y, z) = entry["radius"], entry["center"]
    to_world = mi.ScalarTransform4f([[r, 0, 0, x], [0, 0, -r, y], [0, r, 0, z], [0, 0, 0, 1]])
    return {"type": "sphere", "to_world": to_world}


# Meshes and polygons are lists of separate triangles: positions, normals (or None if they are flat)
# and texture coordinates (or None), each with one row per corner.


def polygon(entry):
    points = np.array(entry["points"], float)
    if "uv" in entry:
        uv = np.array(entry["uv"], float)
    else:
        along = points[1] - points[0]
        along /= np.linalg.norm(along)
        normal = np.cross(points, np.roll(points, -1, axis=0)).sum(axis=0)
        across = np.cross(normal / np.linalg.norm(normal), along)
        uv = (points - points[0]) @ np.stack([along, across], axis=1)
        uv = (uv - uv.min(axis=0)) / np.ptp(uv, axis=0)
    fan = np.array([[0, i, i + 1] for i in range(1, len(points) - 1)]).ravel()
    return points[fan], None, uv[fan]


def mesh(entry, folder):
    positions, faces, normals, uv = read_obj(folder / entry["file"])
    rotation = rotate(entry.get("rotate", [0, 0, 0]))
    positions = positions * entry.get("scale", 1.0) @ rotation.T + entry.get("translate", 0)
    normals = None if normals is None else normals @ rotation.T
    corners = positions[faces].reshape(-1, 3)
    return corners, normals, uv


def read_obj(path):
    """Returns the positions, the faces, and the normals and uv of each corner, or None."""
    lists = {"v": [], "vn": [], "vt": [], "f": []}
    for line in path.read_text().splitlines():
        kind, *words = line.split() or ["#"]
        if kind == "f":
            if len(words) != 3:
                raise ValueError(f"{path}: only triangles are supported")
            corners = [[int(index or 0) for index in word.split("/")] for word in words]
            lists["f"].append(corners)
        elif kind in lists:
            lists[kind].append([float(word) for word in words])
    faces = np.array(lists["f"]) - 1
    def at_corners(kind, column):
        return np.array(lists[kind])[faces[..., column]].reshape(len(faces) * 3, -1)
    uv = at_corners("vt", 1) if lists["vt"] else None
    normals = at_corners("vn", 2) if lists["vn"] else None
    return np.array(lists["v"]), faces[..., 0], normals, uv


def rotate(degrees):
    """Returns the matrix that rotates about x, then y, then z."""
    axes = np.eye(3)
    turns = [mi.ScalarTransform4f().rotate(axis, angle) for axis, angle in zip(axes, degrees)]
    x, y, z = (np.array(turn.matrix)[:3, :3] for turn in turns)
    return z @ y @ x


def write_ply(path, positions, normals, uv):
    columns = [("x", "y", "z"), ("nx", "ny", "nz"), ("u", "v")]
    parts = [positions, normals, uv]
    names = [name for names, part in zip(columns, parts) if part is not None for name in names]
    rows = np.hstack([part for part in parts if part is not None]).astype("<f4")
    count = len(rows) // 3
    faces = np.empty(count, dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"] = 3
    faces["corners"] = np.arange(3 * count).reshape(-1, 3)
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(rows)}",
              *(f"property float {name}" for name in names),
              f"element face {count}", "property list uchar int vertex_indices", "end_header", ""]
    path.write_bytes("\n".join(header).encode() + rows.tobytes() + faces.tobytes())
