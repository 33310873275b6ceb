#pragma once
// The one way to include tinygltf: the macros change its declarations, so every file must set the same. It
// decodes no pictures and knows no file system; what it reads comes from memory (io/gltf_model.cpp).
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>
