"""A camera and a sun that the file animates: every frame has those of its own time, and motion knows both cameras."""

import base64
import json
import math
import struct

from pictures import SMALL_MAPS, read_exr, read_exr_header
from support import TestCase, main

WIDTH, HEIGHT, FPS, FOV = 96, 54, 8, 0.9
CAMERA = ((0.0, 2.0, 8.0), (3.0, 2.5, 7.0))  # at 0 s and at 1 s
YAW = (0.0, 0.35)
SUN_PITCH = (-1.2, -0.5)


def box(low, high):
    """Corners, three a triangle; every triangle casts from both sides."""
    corners = [tuple(high[axis] if corner >> axis & 1 else low[axis] for axis in range(3)) for corner in range(8)]
    faces = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))
    return [corners[i] for a, b, c, d in faces for i in (a, b, c, a, c, d)]


def turn(axis, angle):
    return [math.sin(angle / 2) if i == axis else 0.0 for i in range(3)] + [math.cos(angle / 2)]


class Buffer:
    """A glTF buffer with an accessor for each array that it was given."""

    def __init__(self):
        self.data, self.views, self.accessors = b"", [], []

    def add(self, rows, kind):
        flat = [value for row in rows for value in (row if isinstance(row, (list, tuple)) else [row])]
        packed = struct.pack(f"<{len(flat)}f", *flat)
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        self.data += packed
        accessor = {"bufferView": len(self.views) - 1, "componentType": 5126, "count": len(rows), "type": kind}
        if kind != "VEC4":
            ends = [[row] if kind == "SCALAR" else row for row in rows]
            accessor |= {"min": list(map(min, zip(*ends))), "max": list(map(max, zip(*ends)))}
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def animated_scene(places=CAMERA):
    buffer = Buffer()
    shapes = [buffer.add(box(*ends), "VEC3") for ends in (((-9, -1, -9), (9, 0, 9)), ((-1, 0.5, -1), (1, 2, 1)))]
    times = buffer.add([0.0, 1.0], "SCALAR")
    tracks = [("translation", 1, buffer.add(places, "VEC3")),
              ("rotation", 1, buffer.add([turn(1, angle) for angle in YAW], "VEC4")),
              ("rotation", 2, buffer.add([turn(0, angle) for angle in SUN_PITCH], "VEC4"))]
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 90000}]}},
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": CAMERA[0]},
                  {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": FOV, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": shape}} for shape in shapes]}],
        "animations": [{
            "samplers": [{"input": times, "output": track} for _, _, track in tracks],
            "channels": [{"sampler": i, "target": {"node": node, "path": path}}
                         for i, (path, node, _) in enumerate(tracks)]}],
        "buffers": [{"byteLength": len(buffer.data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(buffer.data).decode()}],
        "bufferViews": buffer.views, "accessors": buffer.accessors,
    }


def mix(ends, t):
    return ends[0] + (ends[1] - ends[0]) * t


def eye_at(seconds):
    return [mix(ends, seconds) for ends in zip(*CAMERA)]


SCALE = HEIGHT / 2 / math.tan(FOV / 2)  # pixels a unit of slope


def world_of(x, y, depth, seconds):
    """The point that a pixel's centre sees at a depth."""
    right, up = (x + 0.5 - WIDTH / 2) / SCALE * depth, (HEIGHT / 2 - y - 0.5) / SCALE * depth
    sine, cosine, eye = math.sin(mix(YAW, seconds)), math.cos(mix(YAW, seconds)), eye_at(seconds)
    return (eye[0] + right * cosine - depth * sine, eye[1] + up, eye[2] - right * sine - depth * cosine)


def pixel_of(point, seconds):
    """Where a point is in the picture, pixels from its upper left corner."""
    x, y, z = (a - b for a, b in zip(point, eye_at(seconds)))
    sine, cosine = math.sin(mix(YAW, seconds)), math.cos(mix(YAW, seconds))
    right, depth = x * cosine - z * sine, -x * sine - z * cosine
    return WIDTH / 2 + right / depth * SCALE, HEIGHT / 2 - y / depth * SCALE


class AnimatedView(TestCase):
    def setUp(self):
        super().setUp()
        self.scene = self.folder / "scene.gltf"
        self.scene.write_text(json.dumps(animated_scene()))

    def draw(self, name, *arguments):
        self.succeed("render", self.scene, "-o", self.folder / name, "--size", f"{WIDTH}x{HEIGHT}", "--quiet",
                     "--fps", FPS, "--set", "cascades.fit=stable", *SMALL_MAPS, *arguments)

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def test_a_frame_is_the_picture_of_its_time(self):
        self.draw("x.png", "--frames", "2:5", "--aov", "shadow,depth")
        for frame in (2, 3, 4, 5):
            self.draw("still.png", "--time", frame / FPS, "--aov", "shadow,depth")
            for suffix in ("", ".shadow", ".depth"):
                with self.subTest(f"{frame}{suffix}"):
                    self.assertEqual(self.bytes_of(f"x_{frame:04}{suffix}.png"), self.bytes_of(f"still{suffix}.png"))
                    if frame > 2:
                        self.assertNotEqual(self.bytes_of(f"x_{frame:04}{suffix}.png"),
                                            self.bytes_of(f"x_{frame - 1:04}{suffix}.png"))

    def test_what_the_command_line_places_stands_still(self):
        view = ("--eye", "0,3,9", "--target", "0,0,0")
        self.draw("sun.png", "--frames", "1:2", "--aov", "shadow,depth", *view)
        self.assertEqual(self.bytes_of("sun_0001.depth.png"), self.bytes_of("sun_0002.depth.png"))
        self.assertNotEqual(self.bytes_of("sun_0001.png"), self.bytes_of("sun_0002.png"))
        self.draw("both.png", "--frames", "1:2", *view, "--sun", "30,50")
        self.assertEqual(self.bytes_of("both_0001.png"), self.bytes_of("both_0002.png"))

    def test_an_automatic_camera_holds_wherever_a_sequence_starts(self):
        document = animated_scene()
        document["nodes"][1] = {"mesh": 0, "translation": CAMERA[0]}  # it moves, and the scene's bounds with it
        del document["cameras"]
        self.scene.write_text(json.dumps(document))
        self.draw("a.png", "--frames", "3:6")
        self.draw("b.png", "--frames", "6:6")
        self.assertEqual(self.bytes_of("a_0006.png"), self.bytes_of("b_0006.png"))
        self.assertNotEqual(self.bytes_of("a_0003.png"), self.bytes_of("a_0006.png"))

    def test_a_comparison_tells_eye_and_target_of_its_first_frame(self):
        self.succeed("compare", self.scene, "-o", self.folder / "report", "--size", "32x18", "--quiet", "--fps", FPS,
                     "--frames", "4:5", "--technique", "hard", "--reference", "brute_force", "--no-cost", *SMALL_MAPS)
        camera = json.loads((self.folder / "report" / "results.json").read_text())["scenes"][0]["camera"]
        seconds = 4 / FPS
        away = math.dist(camera["target"], camera["eye"])
        wanted = (-math.sin(mix(YAW, seconds)) * away, 0, -math.cos(mix(YAW, seconds)) * away)
        for eye, at, target, offset in zip(camera["eye"], eye_at(seconds), camera["target"], wanted):
            self.assertAlmostEqual(eye, at, places=4)
            self.assertAlmostEqual(target, eye + offset, places=3)

    def test_motion_of_what_stands_still_is_the_cameras(self):
        frame = 4
        self.draw("x.exr", "--frames", f"{frame}:{frame}", "--aov", "depth,motion")
        layers = read_exr(self.folder / f"x_{frame:04}.exr")
        seen, longest = 0, 0
        for y in range(HEIGHT):
            for x in range(WIDTH):
                depth = layers["depth.Z"][y][x]
                if depth == 0:
                    continue
                now = world_of(x, y, depth, frame / FPS)
                before = pixel_of(now, (frame - 1) / FPS)
                wanted = (x + 0.5 - before[0], y + 0.5 - before[1])
                motion = (layers["motion.X"][y][x], layers["motion.Y"][y][x])
                self.assertLess(math.dist(motion, wanted), 0.01, (x, y, depth))
                seen, longest = seen + 1, max(longest, math.hypot(*wanted))
        self.assertGreater(seen, WIDTH * HEIGHT / 4)
        self.assertGreater(longest, 3)

    def refused(self, *arguments):
        return self.refuse("render", self.scene, "-o", self.folder / "x.png", "--size", f"{WIDTH}x{HEIGHT}", "--quiet",
                           *SMALL_MAPS, *arguments)

    def test_a_scene_that_reaches_too_far_at_its_time_is_refused(self):
        document = animated_scene([CAMERA[0], (1e37, 0.0, 0.0)])
        moved = document["animations"][0]["channels"][0]["target"]
        limit = "m from the origin, over the limit of 1e+09 m"
        for node in (1, 0):  # the camera, and what is drawn
            moved["node"] = node
            self.scene.write_text(json.dumps(document))
            with self.subTest(node):
                self.draw("still.png", "--time", "0")
                self.assertEqual(self.refused("--time", "1"), f"error: {self.scene}: at 1 s it reaches 1e+37 {limit}")
                self.assertEqual(self.refused("--time", "0", "--frames", "0:2", "--fps", "2"),
                                 f"error: {self.scene}: at 0.5 s it reaches 5e+36 {limit}")
                self.assertTrue((self.folder / "x_0000.png").exists(), "frames before it are written")
        document = animated_scene([(1.0, 1.0, 1.0), (1e30, 1e30, 1e30)])
        document["animations"][0]["channels"][0]["target"] = {"node": 0, "path": "scale"}
        self.scene.write_text(json.dumps(document))
        self.assertIn(f": at 1 s it reaches 9e+30 {limit}", self.refused("--time", "1"))

    def test_a_comparison_names_a_scene_that_reaches_too_far_once(self):
        self.scene.write_text(json.dumps(animated_scene([CAMERA[0], (1e37, 0.0, 0.0)])))
        error = self.refuse("compare", self.scene, "-o", self.folder / "report", "--size", "32x18", "--quiet", "--time",
                            "1", "--technique", "hard", "--reference", "brute_force", "--no-cost", *SMALL_MAPS)
        self.assertEqual(error.count(str(self.scene)), 1, error)
        self.assertIn(": at 1 s it reaches 1e+37 m from the origin", error)

    def test_an_exr_tells_the_view_of_its_own_frame(self):
        self.draw("x.exr", "--frames", "5:6")
        header = read_exr_header(self.folder / "x_0006.exr")
        pitch = mix(SUN_PITCH, 0.75)
        for name, wanted in (("camera.eye", eye_at(0.75)), ("sun.to_light", (0, -math.sin(pitch), math.cos(pitch)))):
            for value, other in zip(map(float, header[f"penumbra:{name}"].split()), wanted):
                self.assertAlmostEqual(value, other, places=4, msg=name)


if __name__ == "__main__":
    main()
