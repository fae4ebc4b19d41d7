"""Lets the add-on of Blender bake scenes of known light, and compares what is then in Blender with that, with `isolux probe`, and with Cycles.

Usage: python judge.py ISOLUX ADDON_FOLDER"""

import atexit
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
import traceback
import zipfile

HOME = tempfile.mkdtemp(prefix="isolux-blender-")
atexit.register(shutil.rmtree, HOME, ignore_errors=True)
os.environ["BLENDER_USER_RESOURCES"] = HOME

import bpy  # noqa: E402 (reads the variable above)
import numpy  # noqa: E402

EFFICACY = 683.0
WATTS, HEIGHT = 100.0, 2.0
REFLECTANCE = 0.5
# Places and candelas go through 32-bit floats, illuminance has the third power of the distance. Measured: 4e-7.
SINGLE = 2e-6
# The light of a vertex at a rim is that of a place beside it, inside. Measured: 2e-4.
RIM = 5e-4
# The whole error that runs are asked for.
ACCURACY = 0.01
# Pixels of Cycles, relative: emission has no noise, 8-bit colours of a lightmap 16 bits of sRGB. Measured: 1e-5.
PIXEL = 1e-4
# Cycles with many samples of one lamp. Measured: 0.1 %.
NOISE = 0.005

isolux, addon = (os.path.abspath(path) for path in sys.argv[1:3])


def install():
    """As users do: a package, into the list of extensions."""
    package = os.path.join(HOME, "isolux.zip")
    with zipfile.ZipFile(package, "w") as file:
        for name in sorted(os.listdir(addon)):
            if name.endswith((".py", ".toml", ".md")):
                file.write(os.path.join(addon, name), name)
    cli = os.path.join(bpy.utils.system_resource("SCRIPTS"), "addons_core", "bl_pkg", "cli", "blender_ext.py")
    subprocess.run([sys.executable, cli, "validate", package], check=True)
    bpy.ops.extensions.package_install_files(filepath=package, repo="user_default", enable_on_install=True)


MODULE = "bl_ext.user_default.isolux"


def preferences():
    return bpy.context.preferences.addons[MODULE].preferences


def empty():
    for family in (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.lights, bpy.data.cameras):
        for data in list(family):
            family.remove(data)
    bpy.context.scene.world = None
    settings = bpy.context.scene.isolux
    settings.accuracy = 100 * ACCURACY
    settings.exposure = 0
    settings.show = "ELEMENTS"
    return settings


def paper(name="paper", reflectance=REFLECTANCE):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.use_backface_culling = True
    principled = material.node_tree.nodes["Principled BSDF"]
    principled.inputs["Base Color"].default_value = (reflectance, reflectance, reflectance, 1)
    principled.inputs["Roughness"].default_value = 1
    principled.inputs["Specular IOR Level"].default_value = 0
    return material


def floor(size=4.0, cuts=20):
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=cuts, y_subdivisions=cuts, size=size)
    thing = bpy.context.object
    thing.name = thing.data.name = "floor"
    thing.data.materials.append(paper())
    return thing


def lamp(kind, energy=WATTS, place=(0, 0, HEIGHT), **more):
    light = bpy.data.lights.new("lamp", kind)
    light.energy = energy
    for name, value in more.items():
        setattr(light, name, value)
    thing = bpy.data.objects.new("lamp", light)
    thing.location = place
    bpy.context.collection.objects.link(thing)
    return thing


def bake(**more):
    assert bpy.ops.isolux.bake(**more) == {"FINISHED"}
    bpy.context.view_layer.update()


def said_by(act):
    try:
        act()
    except RuntimeError as error:
        return str(error)
    raise AssertionError("nothing is refused")


def values(mesh, name, columns=1):
    attribute = mesh.attributes[name]
    found = numpy.empty(columns * len(attribute.data), numpy.float32)
    attribute.data.foreach_get("value" if columns == 1 else "color", found)
    return found.reshape(-1, columns) if columns > 1 else found


def vertices(mesh):
    found = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", found)
    return found.reshape(-1, 3).astype(float)


def made():
    return [thing for thing in bpy.data.objects if thing.get("isolux_made")]


def probe(folder, places, normals, *flags):
    lines = "\n".join(" ".join(repr(float(c)) for c in (*place, *normal)) for place, normal in zip(places, normals))
    said = subprocess.run(
        [isolux, "probe", os.path.join(folder, "map.glb"), "--points", "-", "--json", *flags], input=lines, text=True, check=True, capture_output=True
    )
    return numpy.array([point["illuminance_lx"] for point in json.loads(said.stdout)["points"]])


def below_point(places):
    """Of a point that shines alike everywhere: I cos / d^2."""
    across = numpy.hypot(places[:, 0], places[:, 1])
    return EFFICACY * WATTS / (4 * math.pi) * HEIGHT / (HEIGHT**2 + across**2) ** 1.5


def at_most(what, value, limit):
    assert value <= limit, f"{what} {value:.2g}, more than {limit:.2g}"
    return f"{what} {value:.1e} (at most {limit:.0e})"


def apart(found, due):
    return float(numpy.abs(numpy.asarray(found) / due - 1).max())


def pixel(size=0.2, samples=16):
    """Radiance in the middle of a picture from above, as Cycles finds it."""
    scene = bpy.context.scene
    camera = bpy.data.objects.new("above", bpy.data.cameras.new("above"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", size
    camera.location = (0, 0, 1.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", samples, False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.resolution_x = scene.render.resolution_y = 9
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = os.path.join(HOME, "pixel.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath, check_existing=False)
    image.colorspace_settings.name = "Non-Color"
    found = numpy.array(image.pixels[:]).reshape(9, 9, 4)[3:6, 3:6, :3].mean(axis=(0, 1))
    bpy.data.images.remove(image)
    data = camera.data
    bpy.data.objects.remove(camera)
    bpy.data.cameras.remove(data)
    return found


def mistakes_are_told():
    settings = empty()
    preferences().command = os.path.join(HOME, "nowhere")
    assert "nowhere: is not a program" in said_by(bpy.ops.isolux.bake)
    preferences().command = ""
    path, os.environ["PATH"] = os.environ["PATH"], HOME
    assert "isolux is not found on PATH" in said_by(bpy.ops.isolux.bake)
    os.environ["PATH"] = path
    preferences().command = isolux
    assert "no visible mesh" in said_by(bpy.ops.isolux.bake)
    floor()
    assert "the scene has no light; add a lamp" in said_by(bpy.ops.isolux.bake)
    spot = lamp("SPOT")
    spot.data.use_nodes = True
    tree = spot.data.node_tree
    node = tree.nodes.new("ShaderNodeTexIES")
    node.mode, node.filepath = "EXTERNAL", "//none.ies"
    tree.links.new(node.outputs[0], tree.nodes["Emission"].inputs["Strength"])
    assert "none.ies does not exist" in said_by(bpy.ops.isolux.bake)
    assert not made() and settings.found == ""
    return "each"


def point_above_a_floor():
    empty().show = "OBJECTS"
    thing = floor()
    lamp("POINT")
    keep = os.path.join(HOME, "point")
    bake(keep=keep)
    corners = [loop.vertex_index for loop in thing.data.loops]
    places = vertices(thing.data)[corners]
    lux = values(thing.data, "isolux_lux")
    assert len(lux) > 1000 and (values(thing.data, "isolux_error") >= 0).all()
    inside = numpy.abs(places).max(axis=1) < 1.99
    off = numpy.abs(lux / below_point(places) - 1)
    exact = f"{at_most('from I cos / d^2', off[inside].max(), SINGLE)}, {at_most('at the rim', off.max(), RIM)}"
    normals = [(0, 0, 1)] * len(places)
    probed = at_most("from probe --interpolated", apart(lux, probe(keep, places, normals, "--interpolated")), SINGLE)
    light = values(thing.data, "isolux_light", 4)[:, :3]
    at_most("light", apart(light, (lux / (math.pi * EFFICACY))[:, None]), SINGLE)
    due = REFLECTANCE * below_point(numpy.zeros((1, 3)))[0] / math.pi / EFFICACY
    shown = at_most("Cycles shows it", apart(pixel(0.002), due), PIXEL)
    bpy.context.scene.isolux.exposure = 1
    at_most("a stop more", apart(pixel(0.002), 2 * due), PIXEL)
    assert thing.material_slots[0].material.name == "paper (isolux)"
    bpy.ops.isolux.clear()
    assert thing.material_slots[0].material.name == "paper" and "isolux_lux" not in thing.data.attributes
    own = at_most("as Cycles lights it", apart(pixel(0.002, 256), due), NOISE)
    return f"{len(lux)} corners; {exact}; {probed}; {shown}; {own}"


def furnace():
    empty()
    luminance_w, reflectance = 2.0, 0.6
    bpy.ops.mesh.primitive_cube_add(size=3)
    thing = bpy.context.object
    thing.data.flip_normals()
    thing.data.materials.append(paper("oven", reflectance))
    principled = thing.data.materials[0].node_tree.nodes["Principled BSDF"]
    principled.inputs["Emission Color"].default_value = (1, 1, 1, 1)
    principled.inputs["Emission Strength"].default_value = luminance_w
    keep = os.path.join(HOME, "furnace")
    bake(keep=keep)
    due = math.pi * luminance_w * EFFICACY / (1 - reflectance)
    lux, probed = [], []
    for copy in made():
        mesh = copy.data
        lux.append(values(mesh, "isolux_lux"))
        normals = [vertex.normal for vertex in mesh.vertices]
        probed.append(probe(keep, vertices(mesh), normals, "--interpolated"))
    lux, probed = numpy.concatenate(lux), numpy.concatenate(probed)
    assert thing.hide_render and not thing.visible_get()
    exact = at_most("from pi L / (1 - rho)", apart(lux, due), ACCURACY)
    same = at_most("from probe --interpolated", apart(lux, probed), SINGLE)
    bpy.ops.isolux.clear()
    assert thing.visible_get() and not thing.hide_render and not made()
    return f"{len(lux)} vertices at {lux.mean():.0f} lx; {exact}; {same}"


def lux_below(**more):
    """Of the middle vertex of the floor."""
    bake(**more)
    [copy] = [thing for thing in made() if thing.name.startswith("floor")]
    places = vertices(copy.data)
    return float(values(copy.data, "isolux_lux")[numpy.hypot(places[:, 0], places[:, 1]).argmin()])


def lamps_of_all_kinds():
    empty()
    floor()
    of_point = EFFICACY * WATTS / (4 * math.pi) / HEIGHT**2
    flux = EFFICACY * WATTS
    radius = 0.5
    candela = 300.0
    ies = os.path.join(HOME, "even.ies")
    with open(ies, "w", encoding="utf-8") as file:
        file.write("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 0\n0 90 180\n0\n" + f"{candela} {candela} {candela}\n")
    # A Lambertian disc: L = flux / (pi A), E = pi L sin^2 of its half angle.
    of_disc = flux / (math.pi * radius**2) * radius**2 / (HEIGHT**2 + radius**2)
    told = []
    for what, kind, more, due, limit in (
        ("spot", "SPOT", {"spot_size": 1.0, "spot_blend": 0.2}, of_point, SINGLE),
        ("sun", "SUN", {}, EFFICACY * WATTS, SINGLE),
        # Luminous areas are sampled: their light has the error that was asked for.
        ("disc", "AREA", {"shape": "DISK", "size": 2 * radius}, of_disc, ACCURACY),
        ("colour", "POINT", {"color": (1.0, 0.5, 0.25)}, of_point * (0.2126 + 0.7152 * 0.5 + 0.0722 * 0.25), SINGLE),
        ("IES", "POINT", {"use_nodes": True}, candela / HEIGHT**2, SINGLE),
    ):
        thing = lamp(kind, **more)
        if what == "IES":
            tree = thing.data.node_tree
            node = tree.nodes.new("ShaderNodeTexIES")
            node.mode, node.filepath = "EXTERNAL", ies
            tree.links.new(node.outputs[0], tree.nodes["Emission"].inputs["Strength"])
        told.append(at_most(what, apart(lux_below(), due), limit))
        bpy.ops.isolux.clear()
        bpy.data.objects.remove(thing)
    return "; ".join(told)


def turned_area_light_as_cycles_has_it():
    empty()
    floor()
    thing = lamp("AREA", place=(0.8, 0.3, 1.5), shape="RECTANGLE", size=1.6, size_y=0.2)
    thing.rotation_euler = (0.5, 0.3, 0.9)
    bpy.context.view_layer.update()
    due = pixel(0.02, 4096)
    bake()
    return at_most("Cycles with the lamp and Cycles with the map differ by", apart(pixel(0.02), due), NOISE + ACCURACY)


def the_world_is_told_of():
    empty()
    floor()
    lamp("POINT")
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    bpy.context.scene.world = world
    module = sys.modules[MODULE]
    warnings = []
    for strength in (1.0, 0.0):
        world.node_tree.nodes["Background"].inputs["Strength"].default_value = strength
        made = module.Bake(bpy.context)
        made.run.stop()
        made.end()
        warnings.append(made.warnings)
    bpy.data.worlds.remove(world)
    assert len(warnings[0]) == 1 and "world" in warnings[0][0] and warnings[1] == [], warnings
    return warnings[0][0]


def objects_of_all_kinds():
    settings = empty()
    thing = floor()
    thing.data.materials.append(paper("second"))
    for polygon in thing.data.polygons[:200]:
        polygon.material_index = 1
    twin = bpy.data.objects.new("twin", thing.data)
    inside = bpy.data.objects.new("inner/x", thing.data.copy())
    library = bpy.data.collections.new("library")
    library.objects.link(inside)
    instance = bpy.data.objects.new("instance", None)
    instance.instance_type, instance.instance_collection = "COLLECTION", library
    pane = bpy.data.objects.new("pane", thing.data.copy())
    pane.data.materials.clear()
    pane.data.materials.append(paper("glass", 1.0))
    principled = pane.data.materials[0].node_tree.nodes["Principled BSDF"]
    principled.inputs["Transmission Weight"].default_value, principled.inputs["Roughness"].default_value = 1, 0
    for k, other in enumerate((twin, instance, pane)):
        other.location = (5 * (k + 1), 0, 0)
        bpy.context.collection.objects.link(other)
    lamp("POINT")
    bake()
    shapes = sorted(copy.name.removesuffix(" (isolux)") for copy in made())
    assert shapes == sorted(f"{name} [{k}]" for name in ("floor", "twin", "inner/x") for k in (0, 1)), shapes
    hidden = [other.name for other in (thing, twin, instance, pane) if not other.visible_get()]
    assert hidden == ["floor", "twin", "instance"], hidden
    for copy in made():
        places = vertices(copy.data)
        inner = numpy.abs(places[:, 1]) < 1.99
        inner &= numpy.abs(numpy.mod(places[:, 0] + 2.5, 5) - 2.5) < 1.99
        at_most(copy.name, apart(values(copy.data, "isolux_lux")[inner], below_point(places[inner])), SINGLE)
    settings.show = "OBJECTS"
    bake()
    assert "isolux_lux" not in thing.data.attributes and "isolux_lux" in pane.data.attributes
    bpy.ops.isolux.clear()
    bpy.data.objects.remove(twin)
    bake()
    errors = values(thing.data, "isolux_error")
    assert (errors >= 0).all() and [slot.material.name for slot in thing.material_slots] == ["paper (isolux)", "second (isolux)"]
    assert (values(pane.data, "isolux_error") == -1).all()
    bpy.ops.isolux.clear()
    bpy.data.objects.remove(instance)
    bpy.data.collections.remove(library)
    return f"{', '.join(shapes)}; glass stays as it is"


def textures():
    settings = empty()
    thing = floor()
    code = 0.5
    picture = bpy.data.images.new("grey", 4, 4)
    picture.pixels = [code, code, code, 1.0] * 16
    picture.pack()
    tree = thing.data.materials[0].node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = picture
    tree.links.new(node.outputs["Color"], tree.nodes["Principled BSDF"].inputs["Base Color"])
    lamp("SUN", 1.0)
    # Pictures have 8 bits.
    reflectance = ((round(255 * code) / 255 + 0.055) / 1.055) ** 2.4
    told = []
    for settings.show in ("ELEMENTS", "OBJECTS"):
        bake()
        told.append(at_most(settings.show.lower(), apart(pixel(), reflectance / math.pi), PIXEL))
        bpy.ops.isolux.clear()
    bpy.data.images.remove(picture)
    return "; ".join(told)


def lightmap():
    settings = empty()
    settings.show, settings.texels = "LIGHTMAP", 16
    floor(1.0, 2)
    lamp("SUN", 3.0)
    bake()
    due = REFLECTANCE * 3.0 / math.pi
    found = at_most("rho E / pi", apart(pixel(), due), PIXEL)
    settings.exposure = -1
    at_most("a stop less", apart(pixel(), due / 2), PIXEL)
    bpy.ops.isolux.clear()
    assert not made() and not [image for image in bpy.data.images if image.get("isolux_made")]
    return found


class Window:
    """The context of a window, which this Blender has none of: keeps what it is told."""

    def __init__(self):
        self.lines, self.shares, self.handlers = [], [], []
        self.window = None
        self.workspace = self.window_manager = self

    def __getattr__(self, name):
        return getattr(bpy.context, name)

    def status_text_set(self, line):
        self.lines.append(line)

    def progress_update(self, share):
        self.shares.append(share)

    def progress_begin(self, *_):
        pass

    def progress_end(self):
        pass

    def event_timer_add(self, *_, **__):
        return self

    def event_timer_remove(self, timer):
        assert timer is self

    def modal_handler_add(self, operator):
        self.handlers.append(operator)


class Event:
    def __init__(self, kind, value="PRESS"):
        self.type, self.value = kind, value


def pressed():
    """The operator as its button starts it, outside of Blender's own machinery."""
    operator = sys.modules[MODULE].ISOLUX_OT_bake
    methods = {name: operator.__dict__[name] for name in ("begin", "invoke", "modal", "finish", "fail", "close")}
    started = type("Pressed", (), {**methods, "keep": "", "report": lambda self, kind, words: self.said.append((kind, words))})()
    started.said = []
    window = Window()
    assert started.invoke(window, None) == {"RUNNING_MODAL"} and window.handlers == [started], started.said
    return started, window


def closed_room():
    bpy.ops.mesh.primitive_cube_add(size=3)
    bpy.context.object.data.flip_normals()
    bpy.context.object.data.materials.append(paper())
    lamp("POINT", place=(0.3, 0.2, 0.5))


def progress_is_shown_and_escape_stops():
    settings = empty()
    closed_room()
    started, window = pressed()
    assert started.modal(window, Event("MOUSEMOVE")) == {"PASS_THROUGH"}
    state = {"RUNNING_MODAL"}
    while state == {"RUNNING_MODAL"}:
        time.sleep(0.01)
        state = started.modal(window, Event("TIMER"))
    assert state == {"FINISHED"} and made() and started.said[-1][0] == {"INFO"}, started.said
    told = [line for line in window.lines if line and " left" in line and line.endswith("Esc stops")]
    assert told and window.lines[-1] is None and all(0 <= share <= 1 for share in window.shares), window.lines
    bpy.ops.isolux.clear()
    settings.accuracy = 0.1
    started, window = pressed()
    started.modal(window, Event("TIMER"))
    run = started.bake.run
    assert not run.is_done()
    assert started.modal(window, Event("ESC")) == {"CANCELLED"}
    assert run.is_done() and run.process.returncode != 0 and not os.path.exists(started.bake.folder) and not made()
    assert started.said == [({"WARNING"}, "stopped; there is no light")] and window.lines[-1] is None
    started, window = pressed()
    started.bake.run.error = "a reason"
    started.bake.run.process.kill()
    started.bake.run.process.wait()
    assert started.modal(window, Event("TIMER")) == {"CANCELLED"} and started.said == [({"ERROR"}, "a reason")], started.said
    return told[-1]


CASES = (mistakes_are_told, point_above_a_floor, furnace, lamps_of_all_kinds, turned_area_light_as_cycles_has_it, the_world_is_told_of, objects_of_all_kinds, textures, lightmap, progress_is_shown_and_escape_stops)


def main():
    install()
    failed = 0
    for case in CASES:
        name = case.__name__.replace("_", " ")
        try:
            print(f"ok    {name}: {case()}")
        except Exception as error:
            failed += 1
            print(f"FAILS {name}: {error}")
            traceback.print_exc()
    if failed:
        sys.exit(f"{failed} cases of loaders/blender fail")


main()
