#pragma once
// The OpenGL 4.2 core functions the renderer calls, as pointers that a context fills in. Nothing links a GL
// library: which one would answer is then an accident of link order.

#include <GL/glcorearb.h>

namespace carom::renderer {

// Name without "gl", and the type of its pointer.
#define CAROM_GL_FUNCTIONS(X)                                                                          \
  X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                                                             \
  X(AttachShader, PFNGLATTACHSHADERPROC)                                                               \
  X(BindBuffer, PFNGLBINDBUFFERPROC)                                                                   \
  X(BindBufferBase, PFNGLBINDBUFFERBASEPROC)                                                           \
  X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                                                         \
  X(BindRenderbuffer, PFNGLBINDRENDERBUFFERPROC)                                                       \
  X(BindTexture, PFNGLBINDTEXTUREPROC)                                                                 \
  X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                                                         \
  X(BlendFunc, PFNGLBLENDFUNCPROC)                                                                     \
  X(BlitFramebuffer, PFNGLBLITFRAMEBUFFERPROC)                                                         \
  X(BufferData, PFNGLBUFFERDATAPROC)                                                                   \
  X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)                                           \
  X(Clear, PFNGLCLEARPROC)                                                                             \
  X(CompileShader, PFNGLCOMPILESHADERPROC)                                                             \
  X(CreateProgram, PFNGLCREATEPROGRAMPROC)                                                             \
  X(CreateShader, PFNGLCREATESHADERPROC)                                                               \
  X(DeleteShader, PFNGLDELETESHADERPROC)                                                               \
  X(DepthFunc, PFNGLDEPTHFUNCPROC)                                                                     \
  X(DepthMask, PFNGLDEPTHMASKPROC)                                                                     \
  X(Disable, PFNGLDISABLEPROC)                                                                         \
  X(DrawArrays, PFNGLDRAWARRAYSPROC)                                                                   \
  X(DrawBuffer, PFNGLDRAWBUFFERPROC)                                                                   \
  X(DrawBuffers, PFNGLDRAWBUFFERSPROC)                                                                 \
  X(DrawElementsInstancedBaseVertexBaseInstance, PFNGLDRAWELEMENTSINSTANCEDBASEVERTEXBASEINSTANCEPROC) \
  X(Enable, PFNGLENABLEPROC)                                                                           \
  X(EnableVertexAttribArray, PFNGLENABLEVERTEXATTRIBARRAYPROC)                                         \
  X(Finish, PFNGLFINISHPROC)                                                                           \
  X(FramebufferRenderbuffer, PFNGLFRAMEBUFFERRENDERBUFFERPROC)                                         \
  X(FramebufferTexture2D, PFNGLFRAMEBUFFERTEXTURE2DPROC)                                               \
  X(FrontFace, PFNGLFRONTFACEPROC)                                                                     \
  X(GenBuffers, PFNGLGENBUFFERSPROC)                                                                   \
  X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                                                         \
  X(GenRenderbuffers, PFNGLGENRENDERBUFFERSPROC)                                                       \
  X(GenTextures, PFNGLGENTEXTURESPROC)                                                                 \
  X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                                                         \
  X(GetError, PFNGLGETERRORPROC)                                                                       \
  X(GetIntegerv, PFNGLGETINTEGERVPROC)                                                                 \
  X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)                                                     \
  X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                                                               \
  X(GetShaderInfoLog, PFNGLGETSHADERINFOLOGPROC)                                                       \
  X(GetShaderiv, PFNGLGETSHADERIVPROC)                                                                 \
  X(GetString, PFNGLGETSTRINGPROC)                                                                     \
  X(LinkProgram, PFNGLLINKPROGRAMPROC)                                                                 \
  X(PixelStorei, PFNGLPIXELSTOREIPROC)                                                                 \
  X(PolygonOffset, PFNGLPOLYGONOFFSETPROC)                                                             \
  X(ReadBuffer, PFNGLREADBUFFERPROC)                                                                   \
  X(ReadPixels, PFNGLREADPIXELSPROC)                                                                   \
  X(RenderbufferStorage, PFNGLRENDERBUFFERSTORAGEPROC)                                                 \
  X(Scissor, PFNGLSCISSORPROC)                                                                         \
  X(ShaderSource, PFNGLSHADERSOURCEPROC)                                                               \
  X(TexImage2D, PFNGLTEXIMAGE2DPROC)                                                                   \
  X(TexImage3D, PFNGLTEXIMAGE3DPROC)                                                                   \
  X(TexParameteri, PFNGLTEXPARAMETERIPROC)                                                             \
  X(UseProgram, PFNGLUSEPROGRAMPROC)                                                                   \
  X(VertexAttribDivisor, PFNGLVERTEXATTRIBDIVISORPROC)                                                 \
  X(VertexAttribIPointer, PFNGLVERTEXATTRIBIPOINTERPROC)                                               \
  X(VertexAttribPointer, PFNGLVERTEXATTRIBPOINTERPROC)                                                 \
  X(Viewport, PFNGLVIEWPORTPROC)

struct GlFunctions {
#define CAROM_GL_MEMBER(name, type) type name = nullptr;
  CAROM_GL_FUNCTIONS(CAROM_GL_MEMBER)
#undef CAROM_GL_MEMBER
};

}  // namespace carom::renderer
