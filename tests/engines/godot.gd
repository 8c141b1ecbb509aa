# Draws the pictures that jobs.json asks for, and writes the numbers of each into a file; run by godot.py.
# Each picture is a viewport of its own with one mesh, whose numbers are linear and have 16 bits.
extends SceneTree

const FRAMES = 4  # after which all that is drawn in threads is there

var jobs: Array
var viewports: Array[SubViewport] = []
var shaders := {}
var frames := 0


func _initialize() -> void:
	var text := FileAccess.get_file_as_string("res://jobs.json")
	var asked: Dictionary = JSON.parse_string(text)
	jobs = asked.pictures
	var meshes: Array = asked.meshes.map(_mesh)
	for job in jobs:
		viewports.append(_viewport(job, meshes[job.mesh]))


func _process(_delta: float) -> bool:
	frames += 1
	if frames < FRAMES:
		return false
	for number in viewports.size():
		var image := viewports[number].get_texture().get_image()
		if image.get_format() != Image.FORMAT_RGBAH:
			push_error("a picture has the format %d" % image.get_format())
			continue
		var file := FileAccess.open("res://%s.half" % jobs[number].name, FileAccess.WRITE)
		file.store_buffer(image.get_data())
	return true


func _viewport(job: Dictionary, mesh: ArrayMesh) -> SubViewport:
	var viewport := SubViewport.new()
	viewport.size = Vector2i(job.size[0], job.size[1])
	viewport.use_hdr_2d = true
	viewport.own_world_3d = true
	viewport.transparent_bg = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	var object := MeshInstance3D.new()
	object.mesh = mesh
	object.material_override = _material(job)
	object.transform = _transform(job.object)
	object.extra_cull_margin = 100.0
	viewport.add_child(object)
	var camera := Camera3D.new()
	camera.transform = _transform(job.camera)
	camera.fov = job.fov
	camera.near = job.near
	camera.far = job.far
	viewport.add_child(camera)
	root.add_child(viewport)
	return viewport


func _material(job: Dictionary) -> ShaderMaterial:
	var material := ShaderMaterial.new()
	if not shaders.has(job.shader):
		shaders[job.shader] = load("res://%s.gdshader" % job.shader)
	material.shader = shaders[job.shader]
	for name in job.values:
		material.set_shader_parameter(name, _value(job.values[name]))
	for name in job.textures:
		material.set_shader_parameter(name, _texture(job.textures[name]))
	return material


func _transform(rows: Array) -> Transform3D:
	var columns := range(4).map(func(c): return Vector3(rows[0][c], rows[1][c], rows[2][c]))
	return Transform3D(columns[0], columns[1], columns[2], columns[3])


func _value(given: Dictionary) -> Variant:
	var lanes: Array = given.lanes
	match given.type:
		"float": return float(lanes[0])
		"int", "uint": return int(lanes[0])
		"bool": return bool(lanes[0])
		"vec2": return Vector2(lanes[0], lanes[1])
		"vec3": return Vector3(lanes[0], lanes[1], lanes[2])
		"vec4": return Vector4(lanes[0], lanes[1], lanes[2], lanes[3])
		"ivec2", "uvec2": return Vector2i(lanes[0], lanes[1])
		"ivec3", "uvec3": return Vector3i(lanes[0], lanes[1], lanes[2])
		"ivec4", "uvec4": return Vector4i(lanes[0], lanes[1], lanes[2], lanes[3])
		"mat2": return Transform2D(_pair(lanes, 0), _pair(lanes, 2), Vector2())
		"mat3": return Basis(_triple(lanes, 0), _triple(lanes, 3), _triple(lanes, 6))
		"mat4": return Projection(_four(lanes, 0), _four(lanes, 4), _four(lanes, 8), _four(lanes, 12))
		"float[]": return PackedFloat32Array(lanes)
		"int[]", "uint[]": return PackedInt32Array(lanes)
		"vec2[]": return PackedVector2Array(_each(lanes, 2, _pair))
		"vec3[]": return PackedVector3Array(_each(lanes, 3, _triple))
		"vec4[]": return PackedVector4Array(_each(lanes, 4, _four))
	push_error("no value of the type %s" % given.type)
	return null


func _each(lanes: Array, count: int, made: Callable) -> Array:
	return range(0, lanes.size(), count).map(func(start): return made.call(lanes, start))


func _pair(lanes: Array, start: int) -> Vector2:
	return Vector2(lanes[start], lanes[start + 1])


func _triple(lanes: Array, start: int) -> Vector3:
	return Vector3(lanes[start], lanes[start + 1], lanes[start + 2])


func _four(lanes: Array, start: int) -> Vector4:
	return Vector4(lanes[start], lanes[start + 1], lanes[start + 2], lanes[start + 3])


func _texture(given: Dictionary) -> Texture:
	var images: Array[Image] = []
	for data in given.images:
		var bytes := Marshalls.base64_to_raw(data.bytes)
		images.append(Image.create_from_data(data.width, data.height, data.mips, given.format, bytes))
	match given.dimension:
		"2d":
			return ImageTexture.create_from_image(images[0])
		"2d_array":
			var layers := Texture2DArray.new()
			layers.create_from_images(images)
			return layers
		"cube":
			var cube := Cubemap.new()
			cube.create_from_images(images)
			return cube
	var volume := ImageTexture3D.new()
	volume.create(given.format, given.size[0], given.size[1], given.size[2], given.mips, images)
	return volume


func _mesh(given: Dictionary) -> ArrayMesh:
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	var count: int = given.position.size() / 3
	arrays[Mesh.ARRAY_VERTEX] = PackedVector3Array(_each(given.position, 3, _triple))
	arrays[Mesh.ARRAY_NORMAL] = PackedVector3Array(_each(given.normal, 3, _triple))
	arrays[Mesh.ARRAY_TANGENT] = PackedFloat32Array(given.tangent)
	arrays[Mesh.ARRAY_TEX_UV] = PackedVector2Array(_each(given.uv, 2, _pair))
	arrays[Mesh.ARRAY_TEX_UV2] = PackedVector2Array(_each(given.uv2, 2, _pair))
	# Godot keeps normals, tangents and colours in few bits. These are exact, and godot.py has shaders read them.
	arrays[Mesh.ARRAY_CUSTOM0] = PackedFloat32Array(given.normal4)
	arrays[Mesh.ARRAY_CUSTOM1] = PackedFloat32Array(given.tangent)
	arrays[Mesh.ARRAY_CUSTOM2] = PackedFloat32Array(given.color)
	arrays[Mesh.ARRAY_COLOR] = PackedColorArray(range(count).map(func(_n): return Color.WHITE))
	arrays[Mesh.ARRAY_INDEX] = PackedInt32Array(given.triangles)
	var exact := Mesh.ARRAY_CUSTOM_RGBA_FLOAT
	var flags := 0
	for place in 3:
		flags |= exact << (Mesh.ARRAY_FORMAT_CUSTOM0_SHIFT + place * Mesh.ARRAY_FORMAT_CUSTOM_BITS)
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], {}, flags)
	return mesh
