"""Renders scenes of the benchmarks with Cycles, Blender's path tracer, on the processor.

    blender -b --factory-startup --python-exit-code 1 --python cycles_render.py -- JOB.json...

A job is what write_cycles_job() of cycles_job.cpp writes. The picture goes to the job's `output` as linear EXR, the
CPU seconds of the call that renders (scene, tree and samples; neither start nor file) to JOB.json.seconds.
"""

import json
import math
import os
import sys

import bpy
import mathutils


def diffuse_or_metal(description):
    material = bpy.data.materials.new("material")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    if description["kind"] == "diffuse":
        shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Roughness"].default_value = 0  # Lambert
    else:
        shader = tree.nodes.new("ShaderNodeBsdfGlossy")
        shader.distribution = "GGX"
        shader.inputs["Roughness"].default_value = math.sqrt(description["alpha"])
    shader.inputs["Color"].default_value = (*description["color"], 1)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material


def add_to_scene(name, data):
    made = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(made)
    return made


def add_mesh(description):
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(description["vertices"], [], description["triangles"])
    if "normals" in description:
        for face in mesh.polygons:
            face.use_smooth = True
        if hasattr(mesh, "use_auto_smooth"):  # until Blender 4.0
            mesh.use_auto_smooth = True
            mesh.auto_smooth_angle = math.pi
        mesh.normals_split_custom_set_from_vertices(description["normals"])
    mesh.materials.append(diffuse_or_metal(description["material"]))
    add_to_scene("mesh", mesh)


def aim(what, position, target):
    what.location = position
    view = mathutils.Vector(target) - mathutils.Vector(position)
    what.rotation_euler = view.to_track_quat("-Z", "Y").to_euler()


def add_square_light(description):
    light = bpy.data.lights.new("light", "AREA")
    light.shape = "SQUARE"
    light.size = description["side"]
    # Cycles spreads a light's watts such that a square of radiance L has 4 L side^2 of them, not pi L side^2.
    light.energy = 4 * description["side"] ** 2
    light.color = description["radiance"]
    aim(add_to_scene("light", light), description["center"], description["target"])


def set_sky(description):
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    world.use_nodes = True
    tree = world.node_tree
    if "file" not in description:
        tree.nodes["Background"].inputs["Color"].default_value = (*description["radiance"], 1)
        return
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(description["file"])
    picture.image.colorspace_settings.name = "Non-Color"  # the numbers are radiance
    picture.interpolation = "Closest"
    tree.links.new(picture.outputs["Color"], tree.nodes["Background"].inputs["Color"])


def set_camera(description):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle = math.radians(description["vertical_fov"])
    made = add_to_scene("camera", camera)
    aim(made, description["position"], description["target"])
    bpy.context.scene.camera = made


def set_integrator(job):
    """Plain path tracing: no clamps, no approximations, no denoiser."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = job["spp"]
    cycles.seed = job["seed"]
    cycles.pixel_filter_type = "BOX"
    for off in ("use_adaptive_sampling", "use_denoising", "use_fast_gi", "use_auto_tile"):
        setattr(cycles, off, False)
    for zero in ("sample_clamp_direct", "sample_clamp_indirect", "light_sampling_threshold", "blur_glossy"):
        setattr(cycles, zero, 0)
    for bounces in ("max_bounces", "diffuse_bounces", "glossy_bounces"):
        setattr(cycles, bounces, job["max_scatter"] - 1)  # there 0 is direct light
    render = scene.render
    render.resolution_x, render.resolution_y = job["width"], job["height"]
    render.resolution_percentage = 100
    render.threads_mode = "FIXED"
    render.threads = job["threads"]
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.image_settings.color_mode = "RGB"


def render(file):
    with open(file) as text:
        job = json.load(text)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for mesh in job["meshes"]:
        add_mesh(mesh)
    if "light" in job:
        add_square_light(job["light"])
    set_sky(job["sky"])
    set_camera(job["camera"])
    set_integrator(job)
    before = os.times()
    bpy.ops.render.render()
    after = os.times()
    bpy.data.images["Render Result"].save_render(job["output"])
    with open(file + ".seconds", "w") as text:
        text.write(f"{after.user - before.user + after.system - before.system}\n")


for argument in sys.argv[sys.argv.index("--") + 1:]:
    render(argument)
