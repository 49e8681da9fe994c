#version 420 core
#define BLOCK(n) layout(std140, binding = n)
#define TEXTURE(n) layout(binding = n)
#define encoded(light) (light)  // The framebuffer does.
