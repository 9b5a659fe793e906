/** @file
 * Penumbra: soft shadows for an engine that draws with OpenGL 4.5 or more. The interface for C, for C++ and for other
 * languages: functions, and structs of plain data.
 *
 * In short: penumbra_device_create() in the engine's context; penumbra_settings_create() and penumbra_settings_set();
 * then in each frame, once depth and normals are drawn, penumbra_render(), which gives back a texture with a layer for
 * each light: the share of the light that reaches each pixel. examples/c_minimal is a whole program.
 *
 * Units and spaces. Lengths are in metres, angles in radians. World space is the engine's own, with any axis up.
 * Matrices have 16 floats, column after column as OpenGL takes them, and multiply column vectors. A
 * texture's row 0 is its lowest.
 *
 * Errors. No exception leaves a function, and none fails without a reason: functions return a penumbra_result, and
 * penumbra_last_error() has one line that names the cause. A function that fails changes nothing that its description
 * does not name. Null pointers, structs of a wrong size, values that are not finite, unknown names and values out of
 * range are refused. Fields that a call does not use are not looked at, such as `position` of a sun. What can't be seen
 * from inside is undefined: pointers to other things, and handles that were destroyed.
 *
 * Structs begin with `struct_size`: its caller's sizeof. In later versions of Penumbra structs grow at their end, and
 * nothing else of them changes. A program that was compiled with an earlier version then gets the defaults of the new
 * fields; one that was compiled with a later one is refused if it sets fields which this library does not know. The
 * functions penumbra_..._init() set all fields to their defaults.
 *
 * Threads. An engine may have several devices, with a context each, of one driver or of several, and use them on
 * several threads at the same time. A device is used on one thread at a time, on which its context is current; context
 * and device may move to another thread. Settings, and the lists of parameters and techniques, can be used on any
 * thread, each object on one at a time; calls may share settings that none of them changes. A call on another thread
 * than the device's last one fails if the device's context is not current there (PENUMBRA_ERROR_CONTEXT), and a call
 * while another thread is in one with the device fails too (PENUMBRA_ERROR_ARGUMENT).
 *
 * OpenGL state. "State" at the end of this file says what functions change.
 */
#ifndef PENUMBRA_H
#define PENUMBRA_H

#include <stddef.h>
#include <stdint.h>

/** What functions of the interface are declared with: the shared library exports them. */
#if defined(__GNUC__)
#define PENUMBRA_API __attribute__((visibility("default")))
#else
#define PENUMBRA_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** The version of this header. Programs run with every later library of the same major version. */
#define PENUMBRA_VERSION_MAJOR 0
#define PENUMBRA_VERSION_MINOR 1 /**< Grows with each version that adds functions or fields. */
#define PENUMBRA_VERSION_PATCH 0 /**< Grows with each version that mends faults alone. */

/** The version of the library that runs: 1000000 * major + 1000 * minor + patch. */
PENUMBRA_API uint32_t penumbra_version(void);

/* ---------------------------------------------------------------------------------------------------------- Errors */

/** What functions return: PENUMBRA_OK, or why they failed. penumbra_last_error() has the cause as text. */
typedef enum penumbra_result {
  PENUMBRA_OK = 0,             /**< it has done what it says */
  PENUMBRA_ERROR_ARGUMENT = 1, /**< the call itself: a null pointer, a struct's size, a value that is not finite, a call
                                  from within a callback of a device or while another thread is in a call with it */
  PENUMBRA_ERROR_REFUSED = 2,  /**< what it was given does not suit: textures, matrices, lights, names or values of
                                  parameters; or the driver can't: a shader does not compile, its memory is full */
  PENUMBRA_ERROR_CONTEXT = 3,  /**< no OpenGL context is current, it is not the device's, it can't be drawn with now, it
                                  has no OpenGL 4.5, or the device was abandoned */
  PENUMBRA_ERROR_CALLBACK = 4, /**< penumbra_frame.draw returned something else than 0 */
  PENUMBRA_ERROR_BUFFER = 5,   /**< the caller's buffer is too small for a text: see penumbra_settings_get() */
  PENUMBRA_ERROR_MEMORY = 6,   /**< no memory of the process is left */
  PENUMBRA_ERROR_INTERNAL = 7  /**< a fault of the library: please report it */
} penumbra_result;

/** What went wrong in the last call of this thread that failed: a text without a newline at its end, of one line except
 * for messages of the shader compiler. Never null, "" if none failed; valid until another call of this thread fails. */
PENUMBRA_API const char* penumbra_last_error(void);

/** "PENUMBRA_ERROR_ARGUMENT"; for other values "unknown". */
PENUMBRA_API const char* penumbra_result_name(penumbra_result result);

/* ---------------------------------------------------------------------------------------------------------- Devices */

/** What was made in one OpenGL context: programs, shadow maps, masks and histories. */
typedef struct penumbra_device penumbra_device;

/** A function of OpenGL, to be cast to its own type. */
typedef void (*penumbra_proc)(void);
/** Returns the address of an OpenGL function such as "glCreateTextures", or null, as eglGetProcAddress and
 * glfwGetProcAddress do. `user` is penumbra_device_desc.get_proc_user. */
typedef penumbra_proc (*penumbra_get_proc)(void* user, const char* name);

enum { PENUMBRA_LOG_DEBUG = 0, PENUMBRA_LOG_INFO = 1, PENUMBRA_LOG_WARNING = 2, PENUMBRA_LOG_ERROR = 3 };
/** Receives a message of one line without a newline, valid during the call. `level` is a PENUMBRA_LOG_... */
typedef void (*penumbra_log)(void* user, int32_t level, const char* message);

/** What a device is made from. */
typedef struct penumbra_device_desc {
  size_t struct_size;         /**< sizeof(penumbra_device_desc) */
  penumbra_get_proc get_proc; /**< required; called during penumbra_device_create() */
  void* get_proc_user;        /**< passed to get_proc */
  penumbra_log log; /**< receives messages during calls with the device; null: warnings and errors go to stderr */
  void* log_user;   /**< passed to log */
} penumbra_device_desc;

/** PENUMBRA_ERROR_ARGUMENT: `desc` is null or `struct_size` can be that of no version. */
PENUMBRA_API penumbra_result penumbra_device_desc_init(penumbra_device_desc* desc, size_t struct_size);

/** Makes a device for the current context, which has OpenGL 4.5 or more, of the core or the compatibility profile.
 * Makes one vertex array, by which it knows the context. `device` receives it, or null after an error:
 * PENUMBRA_ERROR_ARGUMENT; PENUMBRA_ERROR_CONTEXT.
 */
PENUMBRA_API penumbra_result penumbra_device_create(const penumbra_device_desc* desc, penumbra_device** device);

/** Deletes the device and all its OpenGL objects. Its context must be current. If it is not, the objects are left
 * to their context, and where that shares objects to its whole share group, and the result is PENUMBRA_ERROR_CONTEXT,
 * which is also logged as a warning; the device is gone nevertheless. Null: nothing happens.
 * PENUMBRA_ERROR_ARGUMENT: called from within a callback of a device, or while another thread is in a call with this
 * one, which stays then. */
PENUMBRA_API penumbra_result penumbra_device_destroy(penumbra_device* device);

/** For a context that is lost or destroyed: forgets all OpenGL objects without an OpenGL call, so that objects of the
 * same names in a new context stay. Needs no context. Only penumbra_device_destroy() can follow: it then needs none
 * either. PENUMBRA_ERROR_ARGUMENT: null, called from within a callback of a device, or while another thread is in a
 * call with this one. */
PENUMBRA_API penumbra_result penumbra_device_abandon(penumbra_device* device);

/* --------------------------------------------------------------------------------------------------------- Settings */

/** Values for all parameters: the technique, the sun's size, sizes of maps, numbers of samples. */
typedef struct penumbra_settings penumbra_settings;

/** Settings with the default values; they need no device. `settings` receives them, or null after an error. */
PENUMBRA_API penumbra_result penumbra_settings_create(penumbra_settings** settings);
/** A copy. `copy` receives it, or null after an error. */
PENUMBRA_API penumbra_result penumbra_settings_clone(const penumbra_settings* settings, penumbra_settings** copy);
/** Null: nothing happens. */
PENUMBRA_API void penumbra_settings_destroy(penumbra_settings* settings);

/** Chooses a technique by its name, or a preset of penumbra_technique_info() with all values that it sets. What the
 * preset that was chosen before had set becomes the default again, unless it was changed since; so does what a preset
 * had set whose values penumbra_settings_read_preset() has read. PENUMBRA_ERROR_REFUSED: unknown name; the message has
 * names that are near. */
PENUMBRA_API penumbra_result penumbra_settings_select(penumbra_settings* settings, const char* technique);

/** Sets a parameter, such as "sun.angle" (degrees), to a value as text, as the option --set of the program takes it: a
 * number, a word, or "true" or "false". PENUMBRA_ERROR_REFUSED: unknown name, or a value that it can't have; nothing is
 * changed then. */
PENUMBRA_API penumbra_result penumbra_settings_set(penumbra_settings* settings, const char* name, const char* value);
/** The same for a number. Integers must be whole, switches 0 or 1; words can't be set so. */
PENUMBRA_API penumbra_result penumbra_settings_set_number(penumbra_settings* settings, const char* name, double value);
/** Sets a parameter to its default, or all of them if `name` is null. PENUMBRA_ERROR_REFUSED: unknown name. */
PENUMBRA_API penumbra_result penumbra_settings_reset(penumbra_settings* settings, const char* name);

/** Writes a parameter's value as text, with a terminating 0, to `text`, which has `capacity` bytes. `length`, unless it
 * is null, receives the number of bytes that the text takes, its terminating 0 among them. If `text` is null and
 * `capacity` 0, only `length` is written. PENUMBRA_ERROR_BUFFER: capacity < *length; nothing of the value is written
 * then, and `text` becomes "", unless `capacity` is 0. All functions with these three arguments work so.
 * PENUMBRA_ERROR_REFUSED: unknown name. */
PENUMBRA_API penumbra_result penumbra_settings_get(const penumbra_settings* settings, const char* name, char* text,
                                                   size_t capacity, size_t* length);
/** A number or a switch (0 or 1). PENUMBRA_ERROR_REFUSED: unknown name, or the value is a word. */
PENUMBRA_API penumbra_result penumbra_settings_get_number(const penumbra_settings* settings, const char* name,
                                                          double* value);

/** Applies the text of a preset file (TOML, as `penumbra view` and --preset write and read it; docs/formats.md), of
 * `length` bytes, at most 1 MiB. Parameters that it does not mention keep their values, and those of the program alone
 * (groups exposure, render, casters, truth and hybrid) are left out. `file`: what messages call the text, such as the
 * file's name. PENUMBRA_ERROR_REFUSED: not TOML, unknown names, values that they can't have, a technique of the program
 * alone; the message begins with "file:line:", and nothing is changed. */
PENUMBRA_API penumbra_result penumbra_settings_read_preset(penumbra_settings* settings, const char* file,
                                                           const char* text, size_t length);
/** Writes the text of a preset file with the technique and every value that is not the default. */
PENUMBRA_API penumbra_result penumbra_settings_write_preset(const penumbra_settings* settings, char* text,
                                                            size_t capacity, size_t* length);

/* ------------------------------------------------------------------------------------ What there is to choose from */

enum { PENUMBRA_TYPE_SWITCH = 0, PENUMBRA_TYPE_INTEGER = 1, PENUMBRA_TYPE_REAL = 2, PENUMBRA_TYPE_WORD = 3 };

/** A parameter. All strings are valid until the program ends. */
typedef struct penumbra_param {
  size_t struct_size;         /**< in: sizeof(penumbra_param) */
  const char* name;           /**< "pcss.filter_taps" */
  const char* help;           /**< one sentence */
  const char* unit;           /**< "m", "deg", "px", "taps"; "": none */
  const char* default_value;  /**< as text */
  int32_t type;               /**< PENUMBRA_TYPE_... */
  uint32_t choice_count;      /**< of words; else 0 */
  const char* const* choices; /**< the words that it takes; null: not a word */
  double least;               /**< the least value of an integer or a real number; else 0 */
  double greatest;            /**< the greatest one; else 0 */
} penumbra_param;

/** The number of parameters. */
PENUMBRA_API size_t penumbra_param_count(void);
/** `index`: below penumbra_param_count(). PENUMBRA_ERROR_ARGUMENT: it is not, null, or a wrong struct_size. */
PENUMBRA_API penumbra_result penumbra_param_info(size_t index, penumbra_param* param);

/** A technique, or a preset: a technique with some parameters set. All strings are valid until the program ends. */
typedef struct penumbra_technique {
  size_t struct_size;  /**< in: sizeof(penumbra_technique) */
  const char* name;    /**< for penumbra_settings_select() */
  const char* summary; /**< one sentence */
  uint32_t is_preset;  /**< 1: a preset; 0: a technique */
  uint32_t suns_only;  /**< 1: lights of the kind PENUMBRA_LAMP are refused; 0: it takes both */
} penumbra_technique;

/** The number of techniques and presets. */
PENUMBRA_API size_t penumbra_technique_count(void);
/** `index`: below penumbra_technique_count(); techniques come first. Errors as for penumbra_param_info(). */
PENUMBRA_API penumbra_result penumbra_technique_info(size_t index, penumbra_technique* technique);

/* ----------------------------------------------------------------------------------------------------------- Lights */

enum {
  PENUMBRA_SUN = 0, /**< infinitely far away. How large it looks: the parameters sun.angle and sun.shape */
  PENUMBRA_LAMP = 1 /**< a sphere that shines in all directions or, with an axis, within a spot's cone */
};

/** A texture of the engine's. Filters, wrap and compare modes do not matter; swizzle, base and maximum level and
 * GL_DEPTH_STENCIL_TEXTURE_MODE must have OpenGL's initial values: a swizzle of channels that are read, another base
 * level and another mode are refused. A view looks at a texture that it was not given in its last three frames: one
 * that is deleted or defined anew and comes back within these needs another name or size, or penumbra_forget_view(). */
typedef struct penumbra_texture {
  uint32_t id;    /**< OpenGL's name; 0: none */
  int32_t width;  /**< of level 0, texels */
  int32_t height; /**< of level 0, texels */
} penumbra_texture;

/** A light that casts shadows. Its colour and intensity stay with the engine. */
typedef struct penumbra_light {
  size_t struct_size; /**< sizeof(penumbra_light); the same for all lights of an array */
  int32_t id;         /**< unique in the frame; the light's maps and history belong to it from frame to frame */
  int32_t kind;       /**< PENUMBRA_SUN (default), PENUMBRA_LAMP */
  float to_light[3];  /**< of a sun: direction to it, world, not 0; default 0, 1, 0 */
  float position[3];  /**< of a lamp: its centre, world, m, each within ±1e6 */
  float radius;       /**< of a lamp, m, 0 (hard shadows) to 1e6; default 0.03 */
  float axis[3];      /**< of a lamp: direction in which a spot shines, world; 0, 0, 0 (default): everywhere */
  float cone;         /**< of a spot: half angle of its cone, rad, above 0 and at most pi/2; beyond it: 0 */
  /** Of a lamp, m: the mask is 0 beyond it; 0 (default): unlimited. Casters nearer to the lamp than 1/2000 of it, or
   * where it is unlimited, of the distance to the farthest corner of penumbra_frame.receivers, cast no shadow. */
  float range;
  const char* const* overrides; /**< "name=value": values of parameters for this light alone; no presets; null if there
                                   are none */
  size_t override_count;        /**< of overrides; default 0 */

  /** A texture of the engine's, by OpenGL's name, to one channel of which the light's visibility is written beside the
   * mask, rounded to the nearest value of the format; 0 (default): none. GL_TEXTURE_2D or GL_TEXTURE_2D_ARRAY,
   * immutable or not, R8, RG8, RGBA8, R16F, RG16F or RGBA16F. All else in it stays as it is: other channels, layers and
   * levels, and texels outside of penumbra_frame.viewport. Lights may share a texture, but not a channel of the same
   * layer and level, nor one that depth, normals, motion or maps are read from. penumbra_render() refuses what does
   * not suit (PENUMBRA_ERROR_REFUSED); it looks at a texture that was no output in the view's last three frames, so one
   * that is defined anew needs another name or penumbra_forget_view(). For penumbra_warm_up() any other value than 0
   * says that the light will have one. */
  uint32_t output_texture;
  int32_t output_level;   /**< its level, which is as large as penumbra_frame.depth; default 0 */
  int32_t output_layer;   /**< its layer, if it is an array; else and by default 0 */
  int32_t output_channel; /**< 0 (default) red, 1 green, 2 blue, 3 alpha */

  /** Shadow maps of a sun or a spot that the engine has drawn; id 0 (default): none, penumbra_frame.draw draws them.
   * Any depth format, or R32F (an array of it is refused with the techniques pcf_hardware and pcf_poisson, whose
   * samplers compare, and with maps.layers=2); 0 is near the light, 1 far, unless maps_reversed says otherwise. A
   * GL_TEXTURE_2D_ARRAY with a layer for each map, or an atlas: see maps_atlas. */
  penumbra_texture maps;
  int32_t maps_size;               /**< width and height of each map, texels */
  int32_t maps_count;              /**< 1 to 8; default 0 */
  uint32_t maps_depth_zero_to_one; /**< 1 (default): clip space of maps_world_to_clip has z in 0..1; 0: in -1..1 */
  /** maps_count matrices of 16 floats, from world to clip space.
   *
   * Of a sun they are orthographic, along the sun's rays, the finest map first; they may overlap or contain each other.
   * Receivers look in the last one first, for how near to the light casters can be: where it does not hold all others,
   * as with a map for each slice of the view, all are copied in each frame, and a further one that does is made from
   * them; there is room for it beside at most 7. With a square sun their x axis must be horizontal.
   * PENUMBRA_ERROR_REFUSED says which map can't serve, and why: perspective, warped, skewed or mirrored ones, depths
   * that grow towards the light, a near plane behind casters (penumbra_frame.casters), whose depths were clamped; or
   * that the last of 8 does not hold all others.
   *
   * Of a spot it is one: a perspective from its centre along its axis, of the same angle in x and y, at least that of
   * its cone, with a near and a far plane, the far one at most 2000 times as far away, and depths of at least 24 bits.
   * Casters before the near plane or outside of the map cast no shadow. Lamps without an axis can't have maps given. */
  const float* maps_world_to_clip;
  /** maps_count pairs of x and y: each map's lower left texel in an atlas, which is a GL_TEXTURE_2D. The maps are
   * copied to an array in each frame. Null (default): `maps` is an array. */
  const int32_t* maps_atlas;
  uint32_t maps_reversed; /**< 1: `maps` are 1 near the light and 0 far (reversed Z), and copied in each frame; default
                             0 */
  uint32_t reserved;      /**< 0 */
} penumbra_light;

/** PENUMBRA_ERROR_ARGUMENT: `light` is null or `struct_size` can be that of no version. */
PENUMBRA_API penumbra_result penumbra_light_init(penumbra_light* light, size_t struct_size);

/* ----------------------------------------------------------------------------------------------- Drawing of casters */

enum {
  /** All casters in the volume, into depth alone. */
  PENUMBRA_PASS_DEPTH = 0,
  /** The same, and colour output 0, a float that is cleared to 0, must end as 1 where a caster that moved since the
   * last frame is nearest to the light: draw the static casters without colour writes, then those that moved,
   * writing 1. */
  PENUMBRA_PASS_DEPTH_AND_MOVED = 1,
  /** Casters that moved, at their present positions; colour output 0 is 1. */
  PENUMBRA_PASS_MOVED_NOW = 2,
  /** Casters that moved, at their last positions, with world_to_clip of this frame; colour output 0 is 1. */
  PENUMBRA_PASS_MOVED_LAST = 3,
  /** All casters (only with the parameter maps.layers=2). Colour output 0, a float that is cleared to 1, must end as
   * the least depth behind the nearest caster: the fragment shader writes gl_FragCoord.z + second_depth_gap, and
   * discards only what an alpha test does. The depth test is against the shadow map itself: leave it, the depth writes
   * that are off, and the blending; use this pass's own matrix, which maps.gap changes. Of closed objects draw only
   * faces that face the light, else their undersides hide what lies below them: front faces, with the winding that they
   * have in the world, so glEnable(GL_CULL_FACE) is enough where these are counter-clockwise. */
  PENUMBRA_PASS_SECOND_DEPTH = 4,
  /** Triangles for shaders of the library (only with the technique shadow_volume): see geometry_shader. */
  PENUMBRA_PASS_GEOMETRY = 5
};

/** One call of penumbra_frame.draw: draw these casters with this matrix. A caster has moved if its place, skin, morph
 * weights or shape differ from the view's last frame; one that appeared is drawn at its present position only, one that
 * disappeared at its last only. PENUMBRA_PASS_DEPTH_AND_MOVED, MOVED_NOW and MOVED_LAST come only with settings that
 * keep a history (penumbra_reads_motion()). */
typedef struct penumbra_caster_pass {
  size_t struct_size;       /**< sizeof(penumbra_caster_pass) of the library */
  int32_t kind;             /**< PENUMBRA_PASS_... */
  int32_t layer;            /**< of the light's shadow map: a cascade of a sun, a face of a lamp's cube; with
                               cascades.fit=penumbrae also of smaller maps that are drawn first, so that a layer may come
                               twice in a frame, with another matrix */
  int32_t view_id;          /**< of the frame */
  uint32_t reserved;        /**< 0 */
  float world_to_clip[16];  /**< clip space has z in 0..1 (GL_ZERO_TO_ONE is set), 0 near the light; under lamps without
                               penumbra_light.maps it is reversed but for PENUMBRA_PASS_GEOMETRY: 1 near the lamp, where
                               the depth range, which is set to 1..0, stores 0. See anchored_to_clip */
  double cull_planes[6][4]; /**< a caster of which every point p has dot(plane.xyz, p) + plane.w < 0 for one of these
                               planes need not be drawn; world space, xyz of unit length; all 0: unused */
  float light_place[4];     /**< world: xyz the direction to a sun and w 0, or the centre of a lamp and w 1 */
  float second_depth_gap;   /**< PENUMBRA_PASS_SECOND_DEPTH: in stored depths; else 0 */
  uint32_t reserved_2;      /**< 0 */
  /** PENUMBRA_PASS_GEOMETRY: the text of a geometry shader, and of a fragment shader, for a program of the engine's;
   * else null. The engine compiles them with a vertex shader of its own, which writes gl_Position = world_to_clip *
   * world position and no other output, and draws each triangle once, as GL_TRIANGLES: opaque casters, and alpha-tested
   * ones as whole triangles. Textures and samplers of units 0 to 8, uniform buffers 0 to 2 and all storage buffers from
   * 4 on must stay as they are bound; the engine's own use others. The texts are valid as long as the device. */
  const char* geometry_shader;
  const char* fragment_shader; /**< see geometry_shader; null too if only depth and stencil are written */
  uint64_t program_id;         /**< from 1: the same for the same texts; 0 for other kinds */
  /** world_to_clip for positions less `anchor`: gl_Position = anchored_to_clip * vec4(position - anchor, 1). Far from
   * the world's origin world_to_clip has too few digits, so that surfaces shadow themselves: under lamps from about
   * 50 m, under suns from 2 km on. Use one of both matrices in all passes of a light, and the anchor of the same pass.
   * For PENUMBRA_PASS_GEOMETRY it is world_to_clip, and the anchor is 0. */
  float anchored_to_clip[16];
  float anchor[4]; /**< world, metres; w is 0 */
} penumbra_caster_pass;

/** Draws casters and returns 0; another value ends penumbra_render() with PENUMBRA_ERROR_CALLBACK. Framebuffer,
 * viewport, scissor, depth test, depth range and clip control are set, and must stay as they are, since a depth
 * range of 0..1 would turn the maps of lamps over; a shader that writes gl_FragDepth writes the stored depth, 0 near
 * the light; culling and polygon offset are off, front faces counter-clockwise and back faces those that would be
 * culled, and no matrix mirrors; the callback binds its own programs and vertex arrays. Both faces of every triangle
 * cast shadows unless the engine decides otherwise. A caster that is drawn in several of these passes must get the same
 * depths, to the bit, in each: compute positions by the same expressions (`invariant gl_Position`). It must not call
 * functions that take a device, or that make one. */
typedef int32_t (*penumbra_draw_casters)(void* user, const penumbra_caster_pass* pass);

/* ----------------------------------------------------------------------------------------------------------- Frames */

/** An axis-aligned box in world space, m. Empty if min > max in every axis, as boxes are after
 * penumbra_frame_init(). */
typedef struct penumbra_box {
  float min[3]; /**< the corner with the least coordinates */
  float max[3]; /**< the corner with the greatest coordinates */
} penumbra_box;

enum {
  PENUMBRA_NORMALS_OCTAHEDRAL = 0, /**< channels R and G: octahedral map (Cigolle et al. 2014), -1..1 */
  PENUMBRA_NORMALS_XYZ = 1         /**< channels R, G and B: x, y, z, -1..1 */
};

/** What penumbra_render() needs of one view in one frame. */
typedef struct penumbra_frame {
  size_t struct_size; /**< sizeof(penumbra_frame) */

  /** The view. Each id has its own maps, mask and history, until penumbra_forget_view(). */
  int32_t view_id;
  uint32_t cut;     /**< 1: discards history and kept maps: a camera cut, another scene, a jump in time; default 0 */
  uint32_t restart; /**< 1: discards the history alone; default 0 */

  /** Conventions. A projection that contradicts reversed_z is refused, and so is a perspective of reversed depth that
   * never reaches -1 if depth_zero_to_one is 0. */
  uint32_t reversed_z; /**< 1 (default): the far plane has depth 0; 0: it has depth 1. Such pixels are sky: lit */
  /** 1 (default): clip space has z in 0..1 (glClipControl); 0: in -1..1, OpenGL's initial state. A wrong value is an
   * error only in the case above, since other matrices of one range are right ones of the other range with other
   * planes. With 1 for a perspective that was drawn with -1..1, positions are about twice as far from the camera as
   * they are, and nearly all shadows are wrong; with 0 for one that was drawn with 0..1, they are about half as far
   * away. So a view's first frame compares the value with glClipControl, and warns once if that says otherwise. Not
   * seen are a 1 for an orthographic projection of reversed depth, and a 1 in a view before whose first frame the
   * device has drawn another view, which sets glClipControl to -1..1. */
  uint32_t depth_zero_to_one;
  int32_t normals_encoding; /**< PENUMBRA_NORMALS_...; default octahedral */

  float view[16]; /**< from world to view space, in metres; it turns and moves, and mirrors for a planar reflection.
                     The camera looks along -z; default: identity */
  float projection[16]; /**< from view to clip space, without jitter; perspective or orthographic, also beside the
                           middle of the picture, with an oblique near plane, or scaled as a whole. What turns the
                           picture belongs into `view`; default: identity */
  /** `view` of the view's last frame, and of this one where there was none; default: identity. Where last_view or
   * last_projection are others than those of that call, the history and the kept maps are discarded. The world's origin
   * must stay where it is: a world that moves around the camera, with the same `view` in each frame, would keep maps
   * and history of another place. An engine that shifts its origin now and then sets `cut` of all views in that frame.
   */
  float last_view[16];
  float last_projection[16]; /**< `projection` of the view's last frame: see last_view */
  float jitter[2];           /**< what was added to x and y of clip space after division by w, -1..1; default 0 */

  /** Depth as drawn: any depth format, or R32F. This texture and the next two may each be a GL_TEXTURE_2D, a layer of a
   * GL_TEXTURE_2D_ARRAY (see depth_layer), or one of both with samples, of which the one nearest to the centre of each
   * pixel is read. All but a GL_TEXTURE_2D are copied in each frame. */
  penumbra_texture depth;
  /** Geometric normals (of the triangle; for those of shading see normals_are_shading), world space, unit length: SNORM
   * or float formats, with normals_scale or normals_offset UNORM ones too (RGBA8, RGB10_A2, RG16), as many channels as
   * normals_encoding needs; the size of `depth`. R11F_G11F_B10F and RGB9_E5 are refused. Or none (id 0): normals are
   * then made from depth, which costs precision: at outlines, on surfaces of less than 3 pixels, and near contacts
   * where depth is coarse. Depth of half floats (R16F) is refused then. */
  penumbra_texture normals;
  /** Motion vectors, or none (id 0): RG, SNORM or float: place of the surface after division by w (-1..1) minus that in
   * the last frame, both without jitter; the size of `depth`. Read only where penumbra_reads_motion() says so. */
  penumbra_texture motion;
  /** The part of the textures that was drawn to, in texels: x and y of the lower left corner, width, height. All of
   * them if it is 0, 0, 0, 0 (default). A change discards the history, as do changes of the size, of conventions, of
   * settings, and for one light any change of its own, such as a sun that moves. */
  int32_t viewport[4];
  /** 1: the mask has a penumbra radius, a blocker distance and a layer of the shadow map beside visibility; default 0.
   */
  uint32_t mask_details;

  /** World bounds of all that casts shadows; not empty, a point (min = max) is valid. Casters are drawn only to texels
   * that lie within, so a tighter box costs less. But planes of maps follow its faces: while casters move within it, it
   * should stay as it is, else maps are not kept. Where a light brings maps of its own, their near planes are checked
   * against it. */
  penumbra_box casters;
  /** The same of all surfaces whose shadows are computed, those drawn forward too. */
  penumbra_box receivers;
  /** World bounds of those receivers that `depth` does not hold, such as glass; default: empty. Maps with the parameter
   * cascades.fit=visible or penumbrae hold them, too, and where there are some, maps.jitter does not move maps from
   * frame to frame: these receivers have no history. */
  penumbra_box forward_receivers;
  uint32_t moved_is_known; /**< 1: `moved` is right; 0 (default): anything may have moved */
  /** World bounds of the casters that moved since the view's last frame, at their present and their last positions, of
   * those that appeared or disappeared, and of those that changed what they cast in another way. Shadow maps that it
   * does not reach are not drawn again, so bounds that are too small leave old shadows. Empty (default): nothing moved.
   */
  penumbra_box moved;
  uint32_t reserved; /**< 0 */

  const penumbra_light* lights; /**< light_count of them; null if there are none */
  size_t light_count;           /**< at most 256 */
  /** Required unless all lights bring their maps, and always with the technique shadow_volume and for the second layers
   * of maps.layers=2. Without it no movement map can be drawn: if the parameter movement.map is on, a history is then
   * used only in frames in which nothing moves (moved_is_known is 1 and `moved` empty). */
  penumbra_draw_casters draw;
  void* draw_user; /**< passed to draw */

  /** 1: `casters` and `receivers` are no larger than what they hold. 0 (default): where they reach farther than 10 km
   * from the camera, as those of a sky's dome do, near shadows stay right, but receivers more than 1 km from the camera
   * are lit (unless cascades.distance says how far shadows reach, or cascades.fit=visible or penumbrae measures it),
   * and so is what casters shadow from more than 10 km along a sun's light. A warning says so once for a view. */
  uint32_t exact_bounds;
  uint32_t reserved_2; /**< 0 */
  /** What `normals` holds, times normals_scale (default 1, not 0) and plus normals_offset (default 0), is in -1..1: 2
   * and -1 for normals that were stored as 0.5 + 0.5 n. */
  float normals_scale;
  float normals_offset; /**< see normals_scale */

  /** Where the textures are arrays, such as those of both eyes of a headset: the layers that this view was drawn to;
   * else 0 (default). */
  int32_t depth_layer;
  int32_t normals_layer; /**< see depth_layer */
  int32_t motion_layer;  /**< see depth_layer */
  /** 1: `normals` are those of shading, interpolated between vertices; default 0. Shadows need those of the triangles,
   * which are then made from depth, as without normals; the given ones say which pixels belong to one surface, and
   * stand in where too few do. */
  uint32_t normals_are_shading;
  /** 1: no surface is drawn forward with the shadows of this frame, so penumbra_bind_forward() is not called. What such
   * surfaces alone read is then not made: the shadow map of the technique shadow_volume, and second layers that
   * maps.overlap finds to be of no use; default 0. */
  uint32_t no_forward_surfaces;
  uint32_t reserved_3; /**< 0 */
} penumbra_frame;

/** PENUMBRA_ERROR_ARGUMENT: `frame` is null or `struct_size` can be that of no version. */
PENUMBRA_API penumbra_result penumbra_frame_init(penumbra_frame* frame, size_t struct_size);

/** The result: a GL_TEXTURE_2D_ARRAY of the size of penumbra_frame.depth, which stays the library's. Layer i belongs to
 * lights[i]. Channel R is visibility: 1 lit, 0 in shadow. If there are details: G the penumbra's radius at the
 * receiver, m (0: none); B the mean distance from receiver to blockers along the light, m (0: none); A the layer of the
 * shadow map that was read, plus 0.5 where the filter is smaller than a texel. Texels outside of the viewport are
 * undefined. */
typedef struct penumbra_mask {
  size_t struct_size; /**< in: sizeof(penumbra_mask) */
  uint32_t texture; /**< OpenGL's name; valid until the next penumbra_render() or penumbra_forget_view() of the view */
  uint32_t format;  /**< GL_R16F (0x822D), or GL_RGBA16F (0x881A) with details: where they were asked for, and with
                       techniques that compute them in any case */
  int32_t width;    /**< texels */
  int32_t height;   /**< texels */
  int32_t layers;   /**< the number of lights; without any 1, whose texels are undefined */
  int32_t view_id;  /**< of the frame */
} penumbra_mask;

/** Computes the shadows of a frame. After an error the view's next frame has no history and draws all maps anew; after
 * one other than PENUMBRA_ERROR_ARGUMENT the view has no mask until a call succeeds. PENUMBRA_ERROR_ARGUMENT, REFUSED,
 * CONTEXT, CALLBACK, MEMORY. */
PENUMBRA_API penumbra_result penumbra_render(penumbra_device* device, const penumbra_settings* settings,
                                             const penumbra_frame* frame, penumbra_mask* mask);

/** Whether penumbra_render() reads penumbra_frame.motion with these settings and lights: `reads` receives 1 or 0. If
 * not, motion vectors need not be drawn. PENUMBRA_ERROR_ARGUMENT; PENUMBRA_ERROR_REFUSED: overrides;
 * PENUMBRA_ERROR_CONTEXT. */
PENUMBRA_API penumbra_result penumbra_reads_motion(penumbra_device* device, const penumbra_settings* settings,
                                                   const penumbra_light* lights, size_t light_count, uint32_t* reads);

/** Releases the maps, the mask and the history of a view; unknown ids have none, and nothing happens.
 * PENUMBRA_ERROR_ARGUMENT, CONTEXT. */
PENUMBRA_API penumbra_result penumbra_forget_view(penumbra_device* device, int32_t view_id);

/** Compiles the programs and makes the tables that penumbra_render() needs with these settings and the frame's
 * conventions, lights, mask_details and no_forward_surfaces, so that no later frame of that kind has to. Of programs
 * that eight calls of penumbra_render() did not use, the device keeps the 512 that were used last. Draws three frames
 * of 60 x 60 pixels, six where maps.overlap may leave out a second layer, with one caster of its own and maps of the
 * settings' size, which are released afterwards: boxes, matrices and callbacks of `frame` are not used and need not be
 * set. Of its textures the formats are used, if they are set: drivers may compile a program anew for another format.
 * Programs that only an engine's own callback compiles are not among them. Errors as for penumbra_render(). */
PENUMBRA_API penumbra_result penumbra_warm_up(penumbra_device* device, const penumbra_settings* settings,
                                              const penumbra_frame* frame);

/* --------------------------------------------------------------------------------- Surfaces that are drawn forward */

/** GLSL for the engine's own fragment shaders, such as those of glass: text to put after the line "#version 450" (or a
 * later version), in which every global name begins with "penumbra_", and which defines a function that returns a
 * float, the light's visibility: penumbra_shadow_visibility(vec3 view_position, vec3 geometric_normal_world, vec2
 * pixel). Its arguments are the surface's place in view space, within the view and penumbra_frame.receivers; its
 * normal, of unit length and to the viewer's side; and gl_FragCoord.xy. `light`: for its kind and overrides; null: a
 * sun without overrides. The text belongs to these settings, overrides and this kind of light: ask again when one of
 * them changes, and compile again if it differs; a program of another text reads wrong shadows, which nothing checks.
 * `text`, `capacity` and `length` as in penumbra_settings_get(), with PENUMBRA_ERROR_BUFFER. PENUMBRA_ERROR_ARGUMENT;
 * PENUMBRA_ERROR_REFUSED: overrides; PENUMBRA_ERROR_CONTEXT. */
PENUMBRA_API penumbra_result penumbra_forward_source(penumbra_device* device, const penumbra_settings* settings,
                                                     const penumbra_light* light, char* text, size_t capacity,
                                                     size_t* length);
/** Binds what that function reads for lights[light_index] of the view's last penumbra_render(): textures and samplers
 * of units 0 to 7, uniform buffers 0 to 2. So a draw reads one light: surfaces under several are drawn once for each,
 * and blended. PENUMBRA_ERROR_ARGUMENT: the view has no mask, or fewer lights; PENUMBRA_ERROR_REFUSED: the frame had
 * no_forward_surfaces, and lacks what they read; PENUMBRA_ERROR_CONTEXT. */
PENUMBRA_API penumbra_result penumbra_bind_forward(penumbra_device* device, int32_t view_id, size_t light_index);
/** Unbinds these textures and samplers. PENUMBRA_ERROR_ARGUMENT, CONTEXT. */
PENUMBRA_API penumbra_result penumbra_unbind_forward(penumbra_device* device);

/* ------------------------------------------------------------------------------------------------------------ State
 * penumbra_render() and penumbra_warm_up() rely on no state of OpenGL 4.5 and restore none; of extensions, the depth
 * bounds test, shading rate images, conservative rasterization, window rectangles, representative fragment tests,
 * viewport swizzles, w scaling, coverage to color and raster multisampling must be off, and in a compatibility profile
 * the render mode must be GL_RENDER. Of the following, what they change
 * is back at OpenGL's initial value afterwards: depth and stencil test, scissor, blend, logic operation, culling, depth
 * clamp, dithering, GL_FRAMEBUFFER_SRGB, rasterizer discard, sample mask, coverage, shading and alpha to coverage or
 * one, line and polygon smoothing, polygon offset, primitive restart, program point size, clip distances 0 to 7; depth
 * function, mask and range, stencil function, operations and mask, colour mask, front face, culled face, polygon mode,
 * clip control, point and line size; and unbound: the program, the vertex array, both framebuffers, textures and
 * samplers of units 0 to 15, images of units 0 to 7, buffers of indirect draws and dispatches. Changed and not reset:
 * all viewports, the scissor box of viewport 0, blend function and equation, uniform buffers 0 to 2, storage buffer 7,
 * and the generic bindings of both. All else is as before, but for what penumbra_frame.draw changes. The same holds
 * after an error, but for PENUMBRA_ERROR_CONTEXT, after which any of the above may have changed.
 * examples/c_minimal/state_guard.c saves and restores what engines usually expect to be as it was.
 *
 * Conditional rendering and transform feedback of the engine's must not be active (paused feedback may be), nor may a
 * display list be recorded. In a view's first frame each of these is PENUMBRA_ERROR_CONTEXT. Later frames look only for
 * feedback and lists, and only in a compatibility profile, because other checks would make drivers wait. Otherwise, if
 * OpenGL leaves out what a later frame draws, masks are wrong until a penumbra_render() of any view of the device is
 * PENUMBRA_ERROR_CONTEXT because of it: usually the second call after that frame, a later one if the GPU is behind.
 * Then all views begin anew. Active feedback also leaves OpenGL's error flag set. An active query counts what the
 * library draws. */

#ifdef __cplusplus
}
#endif

#endif
