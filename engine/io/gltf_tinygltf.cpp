#include <fstream>  // tinygltf's writer needs it even without its file system

#define TINYGLTF_IMPLEMENTATION
#include "io/gltf_tinygltf.h"
