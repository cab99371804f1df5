// What README.md's code in C++ is about: a program of the reader's.
#include <cstdio>
#include <string>

#include <vtm/authoring.hpp>
#include <vtm/gl/renderer.hpp>
#include <vtm/gl/sampled_texture.hpp>
#include <vtm/vtm.hpp>

extern const vtm::Picture picture;
extern const char* const cloudsGlsl;
extern const vtm::scene::Color blue;
extern const vtm::Mask hills, disc;
extern const vtm::Vtm grass, rim;
extern const vtm::scene::Affine small;
extern const std::string yourShader;
extern const unsigned program;
