#define TINYGLTF_IMPLEMENTATION
#include "io/gltf_tinygltf.h"
