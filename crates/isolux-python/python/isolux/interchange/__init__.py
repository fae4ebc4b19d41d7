"""Maps and scenes to and from other software.

Tables of pandas and arrays of xarray (:mod:`tables`), meshes of trimesh and PyVista (:mod:`meshes`), sensor points and results of Radiance
(:mod:`radiance`), models of Honeybee (:mod:`honeybee`). Each of these packages is imported when a function needs it; none is needed to
import this.
"""

from isolux.interchange import honeybee, meshes, radiance, tables

__all__ = ["honeybee", "meshes", "radiance", "tables"]
