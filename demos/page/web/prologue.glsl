// Before the renderer's head.glsl: what GLSL ES 3.00 lacks of GLSL 4.20 (renderer/glsl/desktop.glsl).
#define BLOCK(n) layout(std140)
#define TEXTURE(n)
#define GATHERLESS
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
precision highp sampler2DShadow;
