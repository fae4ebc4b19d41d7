"""Modifiers of Honeybee as materials of Radiance, and which of them a surface has."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

Dict = Mapping[str, Any]

_RGB = "rgb"
#: The numbers of each kind in the order of Radiance; an underscore stands before what each channel has.
_NUMBERS = {
    "Plastic": ("_reflectance", "specularity", "roughness"),
    "Metal": ("_reflectance", "specularity", "roughness"),
    "Trans": ("_reflectance", "specularity", "roughness", "transmitted_diff", "transmitted_spec"),
    "Glass": ("_transmissivity", "refraction_index"),
    "Mirror": ("_reflectance",),
    "Light": ("_emittance",),
    "Glow": ("_emittance", "max_radius"),
}
#: What the schema has where a model says nothing.
_UNSAID = {"Metal": {"specularity": 0.9}, "Mirror": {"_reflectance": 1.0}}


def _plastic(name: str, reflectance: float) -> dict[str, Any]:
    return {"type": "Plastic", "identifier": name} | {f"{c}_reflectance": reflectance for c in _RGB}


def _glass(name: str, transmissivity: float) -> dict[str, Any]:
    return {"type": "Glass", "identifier": name} | {
        f"{c}_transmissivity": transmissivity for c in _RGB
    }


#: The set of models that have none: the generic one of the schema. The names of panes tell transmittances, their numbers transmissivities.
GENERIC: dict[str, Any] = {
    "wall_set": dict.fromkeys(("interior_modifier", "exterior_modifier"), "generic_wall_0.50"),
    "floor_set": dict.fromkeys(("interior_modifier", "exterior_modifier"), "generic_floor_0.20"),
    "roof_ceiling_set": dict.fromkeys(
        ("interior_modifier", "exterior_modifier"), "generic_ceiling_0.80"
    ),
    "aperture_set": {
        "interior_modifier": "generic_interior_window_vis_0.88",
        "window_modifier": "generic_exterior_window_vis_0.64",
        "skylight_modifier": "generic_exterior_window_vis_0.64",
        "operable_modifier": "generic_exterior_window_vis_0.64",
    },
    "door_set": {
        "interior_modifier": "generic_opaque_door_0.50",
        "exterior_modifier": "generic_opaque_door_0.50",
        "overhead_modifier": "generic_opaque_door_0.50",
        "interior_glass_modifier": "generic_interior_window_vis_0.88",
        "exterior_glass_modifier": "generic_exterior_window_vis_0.64",
    },
    "shade_set": {
        "interior_modifier": "generic_interior_shade_0.50",
        "exterior_modifier": "generic_exterior_shade_0.35",
    },
    "context_modifier": "generic_context_0.20",
    "modifiers": [
        _plastic("generic_wall_0.50", 0.5),
        _plastic("generic_floor_0.20", 0.2),
        _plastic("generic_ceiling_0.80", 0.8),
        _plastic("generic_opaque_door_0.50", 0.5),
        _plastic("generic_interior_shade_0.50", 0.5),
        _plastic("generic_exterior_shade_0.35", 0.35),
        _plastic("generic_context_0.20", 0.2),
        _glass("generic_interior_window_vis_0.88", 0.9584154328610596),
        _glass("generic_exterior_window_vis_0.64", 0.6975761815384331),
    ],
}


class Modifiers:
    """All modifiers of a model, by identifier, and its sets of them."""

    def __init__(self, radiance: Dict) -> None:
        self.world = radiance.get("global_modifier_set") or GENERIC
        self.sets = {own["identifier"]: own for own in radiance.get("modifier_sets") or []}
        sources = [self.world, *self.sets.values(), radiance]
        self.known: dict[str, Dict] = {}
        for source in sources:
            for modifier in source.get("modifiers") or []:
                self.known[modifier.get("identifier", "void")] = modifier

    def of_set(self, room: Dict | None, part: str, key: str) -> str:
        """What the set of a room has, or that of the model, or the schema."""
        chosen = _radiance(room).get("modifier_set") if room else None
        for source in (self.sets.get(chosen, {}), self.world, GENERIC):
            found = (source.get(part) or {}).get(key)
            if found:
                return self.name(found)
        raise KeyError(f"{part}.{key}")

    def name(self, modifier: str | Dict) -> str:
        """The identifier of a modifier that is named, or written in place."""
        if isinstance(modifier, str):
            return modifier
        name = str(modifier.get("identifier", "void"))
        self.known.setdefault(name, modifier)
        return name

    def own(self, thing: Dict) -> str | None:
        """The modifier that a surface has for itself."""
        own = _radiance(thing).get("modifier")
        return self.name(own) if own else None

    def of_face(self, face: Dict, room: Dict | None) -> str:
        """The modifier of a face."""
        own = self.own(face)
        if own:
            return own
        part = {"Wall": "wall_set", "Floor": "floor_set", "RoofCeiling": "roof_ceiling_set"}
        side = "exterior_modifier" if is_outside(face) else "interior_modifier"
        return self.of_set(room, part[face["face_type"]], side)

    def of_aperture(self, aperture: Dict, face: Dict | None, room: Dict | None) -> str:
        """The modifier of an aperture."""
        own = self.own(aperture)
        if own:
            return own
        if not is_outside(aperture):
            key = "interior_modifier"
        elif aperture.get("is_operable"):
            key = "operable_modifier"
        else:
            key = "window_modifier" if _is_upright(face) else "skylight_modifier"
        return self.of_set(room, "aperture_set", key)

    def of_door(self, door: Dict, face: Dict | None, room: Dict | None) -> str:
        """The modifier of a door."""
        own = self.own(door)
        if own:
            return own
        glass = "glass_" if door.get("is_glass") else ""
        side = "exterior" if is_outside(door) else "interior"
        if is_outside(door) and not glass and not _is_upright(face):
            side = "overhead"
        return self.of_set(room, "door_set", f"{side}_{glass}modifier")

    def of_shade(self, shade: Dict, is_indoor: bool, room: Dict | None) -> str:
        """The modifier of a shade or a mesh of shades; those that stand alone are surroundings."""
        own = self.own(shade)
        if own:
            return own
        if shade.get("is_detached"):
            return self.name(self.world.get("context_modifier") or GENERIC["context_modifier"])
        side = "interior" if is_indoor else "exterior"
        return self.of_set(room, "shade_set", f"{side}_modifier")


def _radiance(thing: Dict) -> Dict:
    return (thing.get("properties") or {}).get("radiance") or {}


def is_outside(thing: Dict) -> bool:
    """Whether the other side of a surface is outdoors or the ground."""
    kind = (thing.get("boundary_condition") or {}).get("type", "Outdoors")
    return kind in ("Outdoors", "Ground")


def _is_upright(face: Dict | None) -> bool:
    return face is None or face["face_type"] == "Wall"


def to_radiance(name: str, modifier: Dict) -> str:
    """A modifier in the words of Radiance, ``name`` being its name there. Fails with ``ValueError`` where there are none."""
    kind = modifier.get("type", "")
    if kind not in _NUMBERS:
        raise ValueError(f"modifiers of the type {kind or 'unknown'} are not read")
    unsaid: Dict = _UNSAID.get(kind, {})
    numbers: list[float] = []
    for key in _NUMBERS[kind]:
        if key == "refraction_index":
            numbers += [modifier[key]] if modifier.get(key) else []
        elif key.startswith("_"):
            numbers += [modifier.get(c + key, unsaid.get(key, 0.0)) for c in _RGB]
        else:
            numbers.append(modifier.get(key, unsaid.get(key, 0.0)))
    words = " ".join(repr(float(number)) for number in numbers)
    return f"void {kind.lower()} {name}\n0\n0\n{len(numbers)} {words}\n"
