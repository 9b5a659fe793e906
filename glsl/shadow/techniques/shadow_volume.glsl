// What the stages of shadow_volume share. Positions are metres along the world's axes from the camera.

layout(std140, binding = 2) uniform Volumes {
  mat4 to_clip;
  vec4 camera;         // its position in the world
  vec4 eye;            // homogeneous: the origin, or the direction towards the camera if its rays are parallel
  vec4 light;          // homogeneous
  vec4 receivers_min;  // a box that holds all receivers
  vec4 receivers_max;
  float margin;   // a 64th of a pixel: metres where clip w is 1
  float nearest;  // metres: what is nearer to a lamp is a part of it
};

vec3 towards_light(vec3 from) { return light.xyz - light.w * from; }
