"""Mitsuba 3, `llvm_ad_rgb`: `path` with rays of our own that look at the points, or, where light comes by
mirrors, `ptracer` into a camera that sees the whole surface, or, where points may be black, `path` with rays of our own that
look out from the points."""

import os
import sys
import time

import arguments
import library
import scene as scenes

EFFORT = "integrator:samples"
# The camera of `ptracer`: an octant is seen from its corner within 110 degrees.
PIXELS = 64
FIELD_DEG = 112.0
WIDTH_PIXELS = 1.0
# Rays of one launch: more would not be faster.
LAUNCH = 1 << 22


def main():
    flags = arguments.parser(__doc__ + " Integrators: 0 path, 1 ptracer, 2 path over the hemisphere.", EFFORT).parse_args()
    os.environ.setdefault("DRJIT_LIBLLVM_PATH", library.llvm())
    scene = scenes.read(flags.scene)
    points = scene.points(flags.points)
    import drjit
    import mitsuba

    mitsuba.set_variant("llvm_ad_rgb")
    drjit.set_thread_count(flags.threads)
    started = time.perf_counter()
    integrator, samples = flags.effort
    method = (by_path, by_particles, over_hemisphere)[int(integrator)]
    values = method(scene, points, max(1, int(samples)), flags.seed)
    arguments.write(flags.output, values_lx=values, trace_s=time.perf_counter() - started)


def by_path(scene, points, samples, seed):
    """Luminance seen along the normal of every point, which must be diffuse: E = pi L / rho."""
    import drjit as dr
    import mitsuba as mi
    import numpy as np

    world = mi.load_dict(description(scene))
    integrator = mi.load_dict({"type": "path", "max_depth": -1, "rr_depth": 8})
    count = len(points.positions)
    per_launch = max(1, min(samples, LAUNCH // count))
    origins = np.repeat(np.array(scene.just_inside(points), dtype=np.float32), per_launch, axis=0)
    towards = np.repeat(-np.array(points.normals, dtype=np.float32), per_launch, axis=0)
    origin, direction = mi.Point3f(origins.T), mi.Vector3f(towards.T)
    total, launches = np.zeros(count), -(-samples // per_launch)
    for launch in range(launches):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed * 1_000_003 + launch, count * per_launch)
        colour, _, _ = integrator.sample(world, sampler, mi.RayDifferential3f(mi.Ray3f(origin, direction)))
        total += np.array(dr.block_sum(mi.luminance(colour), per_launch))
    reflectance = diffuse_reflectance(scene)
    return [float(x) for x in total / (launches * per_launch) * np.pi / reflectance]


def over_hemisphere(scene, points, samples, seed):
    """What comes in over the hemisphere of every point, `pi` times the mean of luminances seen in directions in proportion to
    the cosine; what lamps without surface send, which no ray meets, is added by their formulae with a shadow ray each."""
    import drjit as dr
    import mitsuba as mi
    import numpy as np

    world = mi.load_dict(description(scene))
    integrator = mi.load_dict({"type": "path", "max_depth": -1, "rr_depth": 8})
    count = len(points.positions)
    per_launch = max(1, min(samples, LAUNCH // count))
    starts = np.array(scene.just_inside(points))
    origin = mi.Point3f(np.repeat(starts.astype(np.float32), per_launch, axis=0).T)
    normal = np.repeat(np.array(points.normals, dtype=np.float32), per_launch, axis=0)
    frame = mi.Frame3f(mi.Vector3f(normal.T))
    total, launches = np.zeros(count), -(-samples // per_launch)
    for launch in range(launches):
        sampler = mi.load_dict({"type": "independent"})
        sampler.seed(seed * 1_000_003 + launch, count * per_launch)
        towards = frame.to_world(mi.warp.square_to_cosine_hemisphere(sampler.next_2d()))
        colour, _, _ = integrator.sample(world, sampler, mi.RayDifferential3f(mi.Ray3f(origin, towards)))
        total += np.array(dr.block_sum(mi.luminance(colour), per_launch))
    seen = total / (launches * per_launch) * np.pi
    return [float(x) for x in seen + straight(world, scene, starts, np.array(points.normals))]


def straight(world, scene, starts, normals):
    """Illuminance from lamps at points and from parallel light, lx."""
    import mitsuba as mi
    import numpy as np

    def lit(way, length_m, intensity):
        cosines = np.sum(way * normals, axis=1)
        ray = mi.Ray3f(mi.Point3f(starts.T), mi.Vector3f(way.T))
        ray.maxt = mi.Float(length_m * (1.0 - 1e-6))
        hidden = np.array(world.ray_test(ray))
        return np.where(hidden, 0.0, np.maximum(cosines, 0.0) * intensity)

    found = np.zeros(len(starts))
    for lamp in scene.luminaires:
        if lamp.web:
            raise SystemExit(f"{lamp.name} has a measured distribution, which Mitsuba has not")
        away = np.array(lamp.position) - starts
        length_m = np.linalg.norm(away, axis=1)
        found += lit(away / length_m[:, None], length_m, lamp.intensity_cd / length_m**2)
    far_m = 10.0 * scene.size_m()
    for sun in scene.suns:
        way = np.tile(-np.array(sun.direction), (len(starts), 1))
        found += lit(way, np.full(len(starts), far_m), sun.illuminance_lx)
    return found


def by_particles(scene, points, samples, seed):
    """Luminance as a camera in the middle of the sphere sees it, fitted around every point."""
    import mitsuba as mi
    import numpy as np

    centre, radius_m = only_sphere(scene)
    world = mi.load_dict({**description(scene), "sensor": camera(scene, centre, samples)})
    integrator = mi.load_dict({"type": "ptracer", "max_depth": -1, "rr_depth": 8})
    picture = np.array(mi.render(world, integrator=integrator, spp=samples, seed=seed))
    luminances = picture[..., :3] @ np.array([0.2126, 0.7152, 0.0722])
    places, coverage = seen_places(world.sensors()[0], np.array(centre), radius_m, scene.box())
    seen = coverage > 0.25
    values = luminances[seen] / coverage[seen] * np.pi / diffuse_reflectance(scene)
    spacing_m = radius_m * np.radians(FIELD_DEG) / PIXELS
    return fitted(places[seen], values, coverage[seen], np.array(points.positions), spacing_m)


def only_sphere(scene):
    spheres = [shape.sphere for shape in scene.shapes if shape.sphere]
    if len(spheres) != 1:
        raise SystemExit(f"{scene.name}: `ptracer` is prepared for a scene with one sphere only")
    return spheres[0]


def camera(scene, centre, samples):
    """From the centre of the sphere, just inside the box of the scene, towards the middle of the box."""
    low, high = scene.box()
    middle = [0.5 * (a + b) for a, b in zip(low, high)]
    origin = [c + 1e-4 * (m - c) for c, m in zip(centre, middle)]
    film = {
        "type": "hdrfilm", "width": PIXELS, "height": PIXELS, "rfilter": {"type": "box"},
        "pixel_format": "rgb", "component_format": "float32",
    }
    return {
        "type": "perspective", "fov": FIELD_DEG, "near_clip": 1e-3, "film": film,
        "sampler": {"type": "independent", "sample_count": samples},
        "to_world": mitsuba_look_at(origin, middle),
    }


def mitsuba_look_at(origin, target):
    import mitsuba as mi

    return mi.ScalarTransform4f().look_at(origin=origin, target=target, up=[0, 0, 1])


def seen_places(sensor, centre, radius_m, box):
    """The mean place of the sphere in every pixel, and the share of the pixel that shows it."""
    import mitsuba as mi
    import numpy as np

    inner = 8
    steps = (np.arange(PIXELS * inner) + 0.5) / (PIXELS * inner)
    u, v = (axis.ravel() for axis in np.meshgrid(steps, steps))
    ray, _ = sensor.sample_ray(0.0, 0.5, mi.Point2f(u, v), mi.Point2f(0.5))
    places = centre + radius_m * np.array(ray.d).T
    shown = np.all((places > np.array(box[0])) & (places < np.array(box[1])), axis=1)
    blocks = np.where(shown[:, None], places, 0.0).reshape(PIXELS, inner, PIXELS, inner, 3)
    count = shown.reshape(PIXELS, inner, PIXELS, inner).sum(axis=(1, 3))
    mean = blocks.sum(axis=(1, 3)) / np.maximum(count, 1)[..., None]
    return mean, count / inner**2


def fitted(places, values, coverage, points, spacing_m):
    """At every point the value of a plane fitted to the pixels around it."""
    import numpy as np

    found = []
    for point in points:
        away = places - point
        near = np.sum(away * away, axis=1)
        weight = np.sqrt(coverage * np.exp(-near / (WIDTH_PIXELS * spacing_m) ** 2))
        used = np.argsort(-weight)[:25]
        basis = np.column_stack([np.ones(len(used)), away[used]]) * weight[used, None]
        # A plane in space through places of a sphere: the direction along the normal is nearly free.
        solution = np.linalg.lstsq(basis, values[used] * weight[used], rcond=1e-3)[0]
        found.append(float(solution[0]))
    return found


def diffuse_reflectance(scene):
    """Of the surfaces that carry the map."""
    found = {scenes.luminance(m.diffuse) for m in scene.materials if max(m.diffuse) > 0}
    if len(found) != 1:
        raise SystemExit(f"{scene.name}: diffuse reflectances {sorted(found)}; this script needs just one")
    return found.pop()


def description(scene):
    """The scene as Mitsuba's dictionary, in photometric units."""
    import mitsuba as mi

    world = {"type": "scene"}
    for lamp in scene.luminaires:
        intensity = {"type": "rgb", "value": [lamp.intensity_cd] * 3}
        world[lamp.name] = {"type": "point", "position": list(lamp.position), "intensity": intensity}
    for sun in scene.suns:
        irradiance = {"type": "rgb", "value": [sun.illuminance_lx] * 3}
        world[sun.name] = {"type": "directional", "direction": list(sun.direction), "irradiance": irradiance}
    for number, shape in enumerate(scene.shapes):
        material = scene.materials[shape.material]
        bsdf = mi.load_dict(surface(material))
        if shape.sphere:
            centre, radius_m = shape.sphere
            world[shape.name] = {
                "type": "sphere", "center": list(centre), "radius": radius_m, "flip_normals": True,
                "surface": bsdf,
            }
        else:
            # Shapes may share a name.
            world[f"{shape.name}_{number}".replace(".", "_")] = mesh(shape, bsdf, material)
    return world


def surface(material):
    if material.pane:
        ior, transmittance = material.pane
        if transmittance != 1.0:
            raise SystemExit(f"{material.name} absorbs, which a `thindielectric` does by another formula")
        return {"type": "thindielectric", "int_ior": ior, "ext_ior": 1.0}
    if max(material.mirror) > 0:
        reflectance = {"type": "rgb", "value": list(material.mirror)}
        return {"type": "conductor", "material": "none", "specular_reflectance": reflectance}
    return {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(material.diffuse)}}


def mesh(shape, bsdf, material):
    import mitsuba as mi
    import numpy as np

    properties = mi.Properties()
    properties["surface"] = bsdf
    if material.shines():
        radiance = {"type": "rgb", "value": list(material.luminance_cd_m2)}
        properties["shine"] = mi.load_dict({"type": "area", "radiance": radiance})
    made = mi.Mesh(shape.name, len(shape.positions), len(shape.triangles), props=properties)
    parameters = mi.traverse(made)
    parameters["vertex_positions"] = np.array(shape.positions, dtype=np.float32).ravel()
    parameters["faces"] = np.array(shape.triangles, dtype=np.uint32).ravel()
    parameters.update()
    return made


if __name__ == "__main__":
    sys.exit(main())
