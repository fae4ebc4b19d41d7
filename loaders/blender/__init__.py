"""Light of a scene by isolux: lux with standard errors, as colours of vertices or as a lightmap."""

import json
import os
import shutil
import tempfile

import bpy
from bpy.props import EnumProperty, FloatProperty, PointerProperty, StringProperty

from . import light_file, shown, written
from .command import Run, Trouble, find

# How often a run is looked at, s.
PERIOD = 0.2


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: StringProperty(name="isolux", subtype="FILE_PATH", description="The command; empty: the one on PATH")

    def draw(self, _context):
        self.layout.prop(self, "command")


class Settings(bpy.types.PropertyGroup):
    accuracy: FloatProperty(
        name="Accuracy", default=2.0, min=0.1, max=20.0, subtype="PERCENTAGE", description="The whole error at which the run stops"
    )
    time_limit: FloatProperty(name="Time Limit", default=0.0, min=0.0, unit="TIME_ABSOLUTE", description="The run stops after this time; 0: no limit")
    efficacy: FloatProperty(
        name="Lumens per Watt", default=683.0, min=1.0, description="What a watt of lamps and of emission is; 683, as Blender exports glTF"
    )
    show: EnumProperty(
        name="Show",
        items=[
            ("ELEMENTS", "Lit Copies", "Copies of all surfaces, as fine as the map, with lux at their vertices"),
            ("OBJECTS", "On the Objects", "Lux at the corners of the objects, as fine as they are"),
            ("LIGHTMAP", "Lightmap", "Copies of all surfaces with their light in a texture"),
        ],
    )
    texels: FloatProperty(name="Texels per Meter", default=0.0, min=0.0, description="Density of a lightmap; 0: some 130 000 texels in all")
    exposure: FloatProperty(
        name="Exposure",
        default=0.0,
        soft_min=-10.0,
        soft_max=10.0,
        description="Stops; at 0 the light is as bright as Cycles renders it",
        update=lambda settings, _context: shown.set_exposure(settings.exposure),
    )
    found: StringProperty()


class Bake:
    """All steps from a scene to its light, one command after another."""

    def __init__(self, context):
        self.settings = context.scene.isolux
        preferences = context.preferences.addons.get(__package__)
        self.program = find(preferences.preferences.command if preferences else "")
        shown.clear(context)
        self.folder = tempfile.mkdtemp(prefix="isolux-")
        try:
            scene, self.warnings = written.write(context, self.folder, self.settings.efficacy)
            self.steps = list(self._steps(scene))
            self.reports = []
            self.run = Run(self.program, self.steps.pop(0))
        except BaseException:
            self.end()
            raise

    def at(self, name):
        return os.path.join(self.folder, name)

    def _steps(self, scene):
        of = self.settings
        solve = ["solve", scene, "-o", self.at("map.glb"), "--accuracy", f"{of.accuracy:g}%", "--progress", "json", "--json"]
        if of.time_limit > 0:
            solve += ["--time-limit", f"{of.time_limit:g}s"]
        yield solve
        export = ["export", self.at("map.glb"), "-o", self.at("light.glb"), "--target", "blender", "--json"]
        if of.show != "LIGHTMAP":
            yield [*export, "--lux"]
        else:
            yield [*export, "--layout", "texels", *(["--texels-per-meter", f"{of.texels:g}"] if of.texels > 0 else [])]

    def goes_on(self):
        """Whether there is more to wait for; the next command follows the one that is done."""
        if not self.run.is_done():
            return True
        self.reports.append(json.loads(self.run.result()))
        self.warnings += self.run.warnings
        if not self.steps:
            return False
        self.run = Run(self.program, self.steps.pop(0))
        return True

    def show(self, context):
        of = self.settings
        report = self.reports[0]
        reached = report.get("accuracy_reached")
        of.found = "error unknown" if reached is None else f"error {100 * reached:.2g} %"
        if of.show == "LIGHTMAP":
            shown.show_lightmap(context, self.at("light.glb"), of.efficacy, of.exposure)
            return
        sides = light_file.read(self.at("light.glb"))
        if of.show == "ELEMENTS":
            shown.show_elements(context, sides, of.efficacy, of.exposure)
            return
        share, shared = shown.show_on_objects(context, sides, of.efficacy, of.exposure)
        if shared:
            self.warnings.append(f"{', '.join(shared)}: several objects have one mesh, which has no light of its own; make them single users")
        if share < 1:
            self.warnings.append(f"{max(1, round(100 * (1 - share)))} % of the corners of objects carry no light: backs, modifiers, or hidden inside others")

    def end(self):
        shutil.rmtree(self.folder, ignore_errors=True)


class ISOLUX_OT_bake(bpy.types.Operator):
    """Compute the light of the visible scene with isolux. Esc stops it"""

    bl_idname = "isolux.bake"
    bl_label = "Bake with isolux"
    bl_options = {"REGISTER", "UNDO"}

    keep: StringProperty(name="Keep", subtype="DIR_PATH", description="A folder that scene and map are copied to", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def begin(self, context):
        try:
            self.bake = Bake(context)
        except (Trouble, OSError, RuntimeError) as trouble:
            self.report({"ERROR"}, str(trouble))
            return False
        return True

    def execute(self, context):
        if not self.begin(context):
            return {"CANCELLED"}
        try:
            while self.bake.goes_on():
                self.bake.run.process.wait()
        except Trouble as trouble:
            return self.fail(context, trouble)
        return self.finish(context)

    def invoke(self, context, _event):
        if not self.begin(context):
            return {"CANCELLED"}
        context.window_manager.progress_begin(0, 1)
        self.timer = context.window_manager.event_timer_add(PERIOD, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC" and event.value == "PRESS":
            self.bake.run.stop()
            self.close(context)
            self.report({"WARNING"}, "stopped; there is no light")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            goes_on = self.bake.goes_on()
        except Trouble as trouble:
            return self.fail(context, trouble)
        if not goes_on:
            return self.finish(context)
        line, share = self.bake.run.progress()
        context.workspace.status_text_set(f"{line}   Esc stops")
        context.window_manager.progress_update(share)
        return {"RUNNING_MODAL"}

    def finish(self, context):
        try:
            self.bake.show(context)
            if self.keep:
                shutil.copytree(self.bake.folder, bpy.path.abspath(self.keep), dirs_exist_ok=True)
        except (Trouble, OSError, RuntimeError) as trouble:
            return self.fail(context, trouble)
        for warning in self.bake.warnings:
            self.report({"WARNING"}, warning)
        self.report({"INFO"}, f"isolux: {context.scene.isolux.found}")
        self.close(context)
        return {"FINISHED"}

    def fail(self, context, trouble):
        self.close(context)
        self.report({"ERROR"}, str(trouble))
        return {"CANCELLED"}

    def close(self, context):
        self.bake.end()
        if getattr(self, "timer", None):
            context.window_manager.event_timer_remove(self.timer)
            context.window_manager.progress_end()
            context.workspace.status_text_set(None)


class ISOLUX_OT_clear(bpy.types.Operator):
    """Take the light away again, and show the objects as they were"""

    bl_idname = "isolux.clear"
    bl_label = "Clear"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        shown.clear(context)
        context.scene.isolux.found = ""
        return {"FINISHED"}


class ISOLUX_PT_panel(bpy.types.Panel):
    bl_label = "isolux"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"

    def draw(self, context):
        of = context.scene.isolux
        self.layout.use_property_split = True
        for name in ("accuracy", "time_limit", "efficacy", "show"):
            self.layout.prop(of, name)
        if of.show == "LIGHTMAP":
            self.layout.prop(of, "texels")
        self.layout.operator("isolux.bake")
        if of.found:
            self.layout.prop(of, "exposure")
            self.layout.label(text=of.found)
            self.layout.operator("isolux.clear")


CLASSES = (Preferences, Settings, ISOLUX_OT_bake, ISOLUX_OT_clear, ISOLUX_PT_panel)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.isolux = PointerProperty(type=Settings)


def unregister():
    del bpy.types.Scene.isolux
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
