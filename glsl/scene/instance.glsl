#include "shared/scene_blocks.h"

layout(std430, binding = 0) readonly restrict buffer Instances { InstanceBlock instances[]; };
