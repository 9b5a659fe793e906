/* The least that an engine does: a square that hovers over a floor, seen from above, and the sun's shadow of it. Prints
 * a column of the mask and ends with 1 if the shadow is not where it must be. */
#include <penumbra/penumbra.h>
#include <stdio.h>
#include <stdlib.h>

#include "gl.h"
#include "state_guard.h"

enum { width = 160, height = 160 };
static const float floor_half = 4, square_half = 1, square_height = 1; /* metres; the floor has y = 0 */

static void check(penumbra_result result) {
  if (result == PENUMBRA_OK) return;
  fprintf(stderr, "error: %s: %s\n", penumbra_result_name(result), penumbra_last_error());
  exit(1);
}

static void on_log(void* user, int32_t level, const char* message) {
  (void)user;
  if (level >= PENUMBRA_LOG_WARNING) fprintf(stderr, "penumbra: %s\n", message);
}

/* ------------------------------------------------------------------------------------- What the engine has already */

typedef struct scene {
  GLuint program, vertices; /* of horizontal squares: uniform 0 the matrix, 1 their centre and half side */
  GLuint depth, normals, framebuffer;
  GLuint shadows; /* of the sun, for a shader that reads them in 8 bits */
} scene;

static GLuint compile(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, NULL);
  glCompileShader(shader);
  return shader;
}

static scene make_scene(void) {
  const GLuint shaders[2] = {
      compile(GL_VERTEX_SHADER,
              "#version 450\n"
              "layout(location = 0) uniform mat4 world_to_clip;\n"
              "layout(location = 1) uniform vec4 square;\n"
              "invariant gl_Position;\n"
              "void main() {\n"
              "  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;\n"
              "  gl_Position = world_to_clip * vec4(square.xyz + vec3(corner.x, 0.0, corner.y) * square.w, 1.0);\n"
              "}\n"),
      compile(GL_FRAGMENT_SHADER,
              "#version 450\n"
              "layout(location = 0) out vec4 normal;\n"
              "void main() { normal = vec4(0.0, 1.0, 0.0, 0.0); }\n")};
  scene made;
  GLint linked = 0;
  made.program = glCreateProgram();
  for (int i = 0; i < 2; ++i) {
    glAttachShader(made.program, shaders[i]);
    glDeleteShader(shaders[i]);
  }
  glLinkProgram(made.program);
  glGetProgramiv(made.program, GL_LINK_STATUS, &linked);
  if (!linked) {
    fprintf(stderr, "error: the program does not link\n");
    exit(1);
  }
  glCreateVertexArrays(1, &made.vertices);
  glCreateTextures(GL_TEXTURE_2D, 1, &made.depth);
  glTextureStorage2D(made.depth, 1, GL_DEPTH_COMPONENT32F, width, height);
  glCreateTextures(GL_TEXTURE_2D, 1, &made.normals);
  glTextureStorage2D(made.normals, 1, GL_RGBA16F, width, height);
  glCreateTextures(GL_TEXTURE_2D, 1, &made.shadows);
  glTextureStorage2D(made.shadows, 1, GL_R8, width, height);
  glCreateFramebuffers(1, &made.framebuffer);
  glNamedFramebufferTexture(made.framebuffer, GL_DEPTH_ATTACHMENT, made.depth, 0);
  glNamedFramebufferTexture(made.framebuffer, GL_COLOR_ATTACHMENT0, made.normals, 0);
  return made;
}

static void draw_square(float y, float half) {
  glUniform4f(1, 0, y, 0, half);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

static void use_program(const scene* scene, const float* world_to_clip) {
  glUseProgram(scene->program);
  glBindVertexArray(scene->vertices);
  glUniformMatrix4fv(0, 1, GL_FALSE, world_to_clip);
}

/* Depth and normals of the floor alone, so that the picture shows the shadow under the square. */
static void draw_depth_and_normals(const scene* scene, const float* world_to_clip) {
  const GLfloat far_depth = 1, no_normal[4] = {0, 0, 0, 0};
  glBindFramebuffer(GL_FRAMEBUFFER, scene->framebuffer);
  glViewport(0, 0, width, height);
  glEnable(GL_DEPTH_TEST);
  glClearBufferfv(GL_DEPTH, 0, &far_depth);
  glClearBufferfv(GL_COLOR, 0, no_normal);
  use_program(scene, world_to_clip);
  draw_square(0, floor_half);
}

/* ------------------------------------------------------------------------------------------- What Penumbra asks for */

static int32_t draw_casters(void* user, const penumbra_caster_pass* pass) {
  const scene* scene = user;
  if (pass->kind != PENUMBRA_PASS_DEPTH) return 1; /* other kinds come with other settings only */
  use_program(scene, pass->world_to_clip);
  draw_square(0, floor_half);
  draw_square(square_height, square_half);
  return 0;
}

/* The camera looks down: x to the right, -z up in the picture. It sees 8 m, and 10 m deep from y = 5 on: a column each.
 */
static const float world_to_view[16] = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, -5, 1};
static const float view_to_clip[16] = {0.25f, 0, 0, 0, 0, 0.25f, 0, 0, 0, 0, -0.2f, 0, 0, 0, -1, 1};
static const float world_to_clip[16] = {0.25f, 0, 0, 0, 0, 0, -0.2f, 0, 0, -0.25f, 0, 0, 0, 0, 0, 1};

static penumbra_frame frame_of(scene* scene, const penumbra_light* light) {
  const penumbra_box all = {{-floor_half, 0, -floor_half}, {floor_half, square_height, floor_half}};
  penumbra_frame frame;
  check(penumbra_frame_init(&frame, sizeof frame));
  for (int i = 0; i < 16; ++i) {
    frame.view[i] = frame.last_view[i] = world_to_view[i];
    frame.projection[i] = frame.last_projection[i] = view_to_clip[i];
  }
  frame.reversed_z = 0; /* OpenGL's own conventions: near 0, far 1, clip space -1..1 */
  frame.depth_zero_to_one = 0;
  frame.normals_encoding = PENUMBRA_NORMALS_XYZ;
  frame.depth.id = scene->depth;
  frame.normals.id = scene->normals;
  frame.depth.width = frame.normals.width = width;
  frame.depth.height = frame.normals.height = height;
  frame.casters = frame.receivers = all;
  frame.moved_is_known = 1; /* nothing moves: `moved` is empty */
  frame.lights = light;
  frame.light_count = 1;
  frame.draw = draw_casters;
  frame.draw_user = scene;
  return frame;
}

static int is_right(const float* row, float light_x) {
  /* The square's shadow on the floor, along x. */
  const float middle = -light_x * square_height;
  for (int i = 0; i < width; ++i) {
    const float x = ((float)i + 0.5f) / width * 2 * floor_half - floor_half;
    const float inside = square_half - (x > middle ? x - middle : middle - x); /* metres from the edge */
    if (inside > 0.1f && row[i] > 0.01f) return 0;
    if (inside < -0.1f && row[i] < 0.99f) return 0;
  }
  return 1;
}

int main(void) {
  static float mask_row[width], shadows_row[width];
  penumbra_device_desc desc;
  penumbra_device* device = NULL;
  penumbra_settings* settings = NULL;
  penumbra_light sun;
  penumbra_frame frame;
  penumbra_mask mask = {0};
  state_guard guard;
  scene scene;

  if (!make_context()) {
    fprintf(stderr, "error: no OpenGL 4.5\n");
    return 1;
  }
  scene = make_scene();

  check(penumbra_device_desc_init(&desc, sizeof desc));
  desc.get_proc = get_proc;
  desc.log = on_log;
  check(penumbra_device_create(&desc, &device));
  check(penumbra_settings_create(&settings));
  check(penumbra_settings_set_number(settings, "sun.angle", 2));

  check(penumbra_light_init(&sun, sizeof sun));
  sun.to_light[0] = 0.75f; /* to the right, and as high as it is long */
  sun.to_light[1] = 1;
  sun.output_texture = scene.shadows; /* only for engines that want the result in a texture of their own */
  frame = frame_of(&scene, &sun);
  check(penumbra_warm_up(device, settings, &frame)); /* while the level loads */

  /* In each frame: */
  draw_depth_and_normals(&scene, world_to_clip);
  save_state(&guard);
  mask.struct_size = sizeof mask;
  check(penumbra_render(device, settings, &frame, &mask));
  restore_state(&guard);
  /* Now the engine multiplies the sun's light by texelFetch(mask, ivec3(gl_FragCoord.xy, 0), 0).r, or by the same value
   * in 8 bits, texelFetch(shadows, ivec2(gl_FragCoord.xy), 0).r. */

  glGetTextureSubImage(mask.texture, 0, 0, height / 2, 0, width, 1, 1, GL_RED, GL_FLOAT, sizeof mask_row, mask_row);
  glGetTextureSubImage(scene.shadows, 0, 0, height / 2, 0, width, 1, 1, GL_RED, GL_FLOAT, sizeof shadows_row,
                       shadows_row);
  for (int i = 4; i < width; i += 8) printf("%.2f ", (double)mask_row[i]);
  printf("\n");

  penumbra_settings_destroy(settings);
  check(penumbra_device_destroy(device));
  glDeleteTextures(1, &scene.depth);
  glDeleteTextures(1, &scene.normals);
  glDeleteTextures(1, &scene.shadows);
  glDeleteFramebuffers(1, &scene.framebuffer);
  glDeleteVertexArrays(1, &scene.vertices);
  glDeleteProgram(scene.program);
  if (!is_right(mask_row, sun.to_light[0]) || !is_right(shadows_row, sun.to_light[0])) {
    fprintf(stderr, "error: the shadow is not where it must be\n");
    return 1;
  }
  return 0;
}
