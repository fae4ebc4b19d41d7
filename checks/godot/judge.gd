# Shows card.glb of this project in Godot 3, with no more than a project has to set: its importer leaves out the strength of
# emission (KHR_materials_emissive_strength), so that the material is given it times the exposure; and that vertices have
# colours, and that materials are unlit (KHR_materials_unlit), so that it is told. Godot 4 reads all of these.
# Usage: godot3 --path PROJECT -s judge.gd ENERGY, of which 0 stands for colours of vertices; prints the codes of the middle
# of the picture.
extends SceneTree

# The first pictures are drawn before all is loaded.
const FRAMES = 8

var viewport = Viewport.new()
var frames = 0

func _init():
	var given = OS.get_cmdline_args()
	var card = load("res://card.glb").instance()
	prepare(card, float(given[given.size() - 1]))
	viewport.size = Vector2(9, 9)
	viewport.own_world = true
	viewport.render_target_update_mode = Viewport.UPDATE_ALWAYS
	for node in [card, nothing_else(), camera()]:
		viewport.add_child(node)
	get_root().add_child(viewport)

func prepare(node, energy):
	if node is MeshInstance:
		for k in range(node.mesh.get_surface_count()):
			var material = node.mesh.surface_get_material(k)
			if energy > 0:
				material.emission_energy = energy
			else:
				material.flags_unshaded = true
				material.vertex_color_use_as_albedo = true
	for child in node.get_children():
		prepare(child, energy)

# No light but that of the card, and no tone mapping but the encoding as sRGB.
func nothing_else():
	var place = WorldEnvironment.new()
	place.environment = Environment.new()
	place.environment.background_mode = Environment.BG_COLOR
	place.environment.ambient_light_energy = 0.0
	place.environment.tonemap_mode = Environment.TONE_MAPPER_LINEAR
	return place

# Above the middle of the card, which lies from (0, 0, 0) to (1, 0, -1).
func camera():
	var eye = Camera.new()
	eye.projection = Camera.PROJECTION_ORTHOGONAL
	eye.size = 0.4
	eye.transform = Transform(Basis(Vector3(1, 0, 0), -PI / 2), Vector3(0.5, 1, -0.5))
	eye.current = true
	return eye

func _idle(_delta):
	frames += 1
	if frames < FRAMES:
		return false
	var picture = viewport.get_texture().get_data()
	picture.lock()
	var middle = picture.get_pixel(4, 4)
	print("codes ", 255 * middle.r, " ", 255 * middle.g, " ", 255 * middle.b)
	quit()
	return true
