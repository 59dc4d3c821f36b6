/* The functions of OpenGL that slosh calls, for sim/gpu/gl_calls.c: kind of the call, type, name,
   parameters, arguments. A program runs by the calls of GL_RUN. A row GL_SETTING has the condition for a call
   without effect (sim/gpu/gl_known.h) in place of the kind. tests/tree/test_gl_calls.py holds the rows
   against the sources. */
#ifndef GL_RUN
#define GL_RUN GL_CALL
#endif
#ifndef GL_SETTING
#define GL_SETTING GL_CALL
#endif

GL_CALL(CALL_OTHER, void, glAttachShader, (GLuint a, GLuint b), (a, b))
GL_CALL(CALL_OTHER, void, glBeginConditionalRender, (GLuint a, GLenum b), (a, b))
GL_CALL(CALL_OTHER, void, glBeginQuery, (GLenum a, GLuint b), (a, b))
GL_CALL(CALL_OTHER, void, glBeginTransformFeedback, (GLenum a), (a))
GL_SETTING(bound(a, b), void, glBindBuffer, (GLenum a, GLuint b), (a, b))
GL_SETTING(known_buffers(a, b, 1, &c), void, glBindBufferBase, (GLenum a, GLuint b, GLuint c), (a, b, c))
GL_SETTING(unknown_buffers(a, b, 1), void, glBindBufferRange,
           (GLenum a, GLuint b, GLuint c, GLintptr d, GLsizeiptr e), (a, b, c, d, e))
GL_SETTING(known_buffers(a, b, c, d), void, glBindBuffersBase,
           (GLenum a, GLuint b, GLsizei c, const GLuint *d), (a, b, c, d))
GL_SETTING(unknown_buffers(a, b, c), void, glBindBuffersRange,
           (GLenum a, GLuint b, GLsizei c, const GLuint *d, const GLintptr *e, const GLsizeiptr *f),
           (a, b, c, d, e, f))
GL_SETTING(known_framebuffer(a, b), void, glBindFramebuffer, (GLenum a, GLuint b), (a, b))
GL_CALL(CALL_OTHER, void, glBindImageTexture,
        (GLuint a, GLuint b, GLint c, GLboolean d, GLint e, GLenum f, GLenum g), (a, b, c, d, e, f, g))
GL_SETTING(known_textures(a, 1, &b), void, glBindTextureUnit, (GLuint a, GLuint b), (a, b))
GL_SETTING(known_textures(a, b, c), void, glBindTextures, (GLuint a, GLsizei b, const GLuint *c), (a, b, c))
GL_CALL(CALL_OTHER, void, glBindTransformFeedback, (GLenum a, GLuint b), (a, b))
GL_SETTING(KNOWN(VERTEX_ARRAY, a), void, glBindVertexArray, (GLuint a), (a))
GL_SETTING(KNOWN(BLEND_EQUATION, a), void, glBlendEquation, (GLenum a), (a))
GL_SETTING(unknown_state(KNOWN_BLEND_EQUATION), void, glBlendEquationi, (GLuint a, GLenum b), (a, b))
GL_SETTING(KNOWN(BLEND, a, b, a, b), void, glBlendFunc, (GLenum a, GLenum b), (a, b))
GL_SETTING(KNOWN(BLEND, a, b, c, d), void, glBlendFuncSeparate, (GLenum a, GLenum b, GLenum c, GLenum d),
           (a, b, c, d))
GL_CALL(CALL_OTHER, void, glBlitNamedFramebuffer,
        (GLuint a, GLuint b, GLint c, GLint d, GLint e, GLint f, GLint g, GLint h, GLint i, GLint j,
         GLbitfield k, GLenum l),
        (a, b, c, d, e, f, g, h, i, j, k, l))
GL_CALL(CALL_QUESTION, GLenum, glCheckNamedFramebufferStatus, (GLuint a, GLenum b), (a, b))
GL_CALL(CALL_OTHER, void, glClear, (GLbitfield a), (a))
GL_CALL(CALL_OTHER, void, glClearBufferfi, (GLenum a, GLint b, GLfloat c, GLint d), (a, b, c, d))
GL_CALL(CALL_OTHER, void, glClearBufferfv, (GLenum a, GLint b, const GLfloat *c), (a, b, c))
GL_CALL(CALL_OTHER, void, glClearColor, (GLfloat a, GLfloat b, GLfloat c, GLfloat d), (a, b, c, d))
GL_CALL(CALL_OTHER, void, glClearNamedBufferData, (GLuint a, GLenum b, GLenum c, GLenum d, const void *e),
        (a, b, c, d, e))
GL_CALL(CALL_OTHER, void, glClearNamedBufferSubData,
        (GLuint a, GLenum b, GLintptr c, GLsizeiptr d, GLenum e, GLenum f, const void *g),
        (a, b, c, d, e, f, g))
GL_CALL(CALL_OTHER, void, glClearNamedFramebufferfv, (GLuint a, GLenum b, GLint c, const GLfloat *d),
        (a, b, c, d))
GL_CALL(CALL_OTHER, void, glClearNamedFramebufferuiv, (GLuint a, GLenum b, GLint c, const GLuint *d),
        (a, b, c, d))
GL_CALL(CALL_OTHER, void, glClearTexImage, (GLuint a, GLint b, GLenum c, GLenum d, const void *e),
        (a, b, c, d, e))
GL_CALL(waited(c), GLenum, glClientWaitSync, (GLsync a, GLbitfield b, GLuint64 c), (a, b, c))
GL_SETTING(KNOWN(CLIP, a, b), void, glClipControl, (GLenum a, GLenum b), (a, b))
GL_SETTING(KNOWN(COLOR_MASK, a, b, c, d), void, glColorMask,
           (GLboolean a, GLboolean b, GLboolean c, GLboolean d), (a, b, c, d))
GL_CALL(CALL_OTHER, void, glCompileShader, (GLuint a), (a))
GL_CALL(CALL_OTHER, void, glCopyImageSubData,
        (GLuint a, GLenum b, GLint c, GLint d, GLint e, GLint f, GLuint g, GLenum h, GLint i, GLint j,
         GLint k, GLint l, GLsizei m, GLsizei n, GLsizei o),
        (a, b, c, d, e, f, g, h, i, j, k, l, m, n, o))
GL_CALL(sent(e), void, glCopyNamedBufferSubData, (GLuint a, GLuint b, GLintptr c, GLintptr d, GLsizeiptr e),
        (a, b, c, d, e))
GL_CALL(CALL_OTHER, void, glCreateBuffers, (GLsizei a, GLuint *b), (a, b))
GL_CALL(CALL_OTHER, void, glCreateFramebuffers, (GLsizei a, GLuint *b), (a, b))
GL_CALL(CALL_OTHER, GLuint, glCreateProgram, (void), ())
GL_CALL(CALL_OTHER, void, glCreateQueries, (GLenum a, GLsizei b, GLuint *c), (a, b, c))
GL_CALL(CALL_OTHER, GLuint, glCreateShader, (GLenum a), (a))
GL_CALL(CALL_OTHER, void, glCreateTextures, (GLenum a, GLsizei b, GLuint *c), (a, b, c))
GL_CALL(CALL_OTHER, void, glCreateTransformFeedbacks, (GLsizei a, GLuint *b), (a, b))
GL_CALL(CALL_OTHER, void, glCreateVertexArrays, (GLsizei a, GLuint *b), (a, b))
GL_SETTING(KNOWN(CULLED, a), void, glCullFace, (GLenum a), (a))
GL_CALL(CALL_OTHER, void, glDebugMessageCallback, (GLDEBUGPROC a, const void *b), (a, b))
GL_CALL(CALL_OTHER, void, glDebugMessageControl,
        (GLenum a, GLenum b, GLenum c, GLsizei d, const GLuint *e, GLboolean f), (a, b, c, d, e, f))
GL_SETTING(unknown_names(), void, glDeleteBuffers, (GLsizei a, const GLuint *b), (a, b))
GL_SETTING(unknown_names(), void, glDeleteFramebuffers, (GLsizei a, const GLuint *b), (a, b))
GL_SETTING(unknown_uniforms(a), void, glDeleteProgram, (GLuint a), (a))
GL_CALL(CALL_OTHER, void, glDeleteQueries, (GLsizei a, const GLuint *b), (a, b))
GL_CALL(CALL_OTHER, void, glDeleteShader, (GLuint a), (a))
GL_CALL(CALL_OTHER, void, glDeleteSync, (GLsync a), (a))
GL_SETTING(unknown_names(), void, glDeleteTextures, (GLsizei a, const GLuint *b), (a, b))
GL_CALL(CALL_OTHER, void, glDeleteTransformFeedbacks, (GLsizei a, const GLuint *b), (a, b))
GL_SETTING(unknown_names(), void, glDeleteVertexArrays, (GLsizei a, const GLuint *b), (a, b))
GL_SETTING(KNOWN(DEPTH_FUNCTION, a), void, glDepthFunc, (GLenum a), (a))
GL_SETTING(KNOWN(DEPTH_MASK, a), void, glDepthMask, (GLboolean a), (a))
GL_CALL(CALL_OTHER, void, glDepthRange, (GLdouble a, GLdouble b), (a, b))
GL_SETTING(known_capability(a, false), void, glDisable, (GLenum a), (a))
GL_RUN(CALL_DISPATCH, void, glDispatchCompute, (GLuint a, GLuint b, GLuint c), (a, b, c))
GL_RUN(CALL_DISPATCH, void, glDispatchComputeIndirect, (GLintptr a), (a))
GL_RUN(CALL_DRAW, void, glDrawArrays, (GLenum a, GLint b, GLsizei c), (a, b, c))
GL_RUN(CALL_DRAW, void, glDrawArraysIndirect, (GLenum a, const void *b), (a, b))
GL_RUN(CALL_DRAW, void, glDrawArraysInstanced, (GLenum a, GLint b, GLsizei c, GLsizei d), (a, b, c, d))
GL_RUN(CALL_DRAW, void, glDrawElements, (GLenum a, GLsizei b, GLenum c, const void *d), (a, b, c, d))
GL_RUN(CALL_DRAW, void, glDrawElementsIndirect, (GLenum a, GLenum b, const void *c), (a, b, c))
GL_RUN(CALL_DRAW, void, glDrawTransformFeedback, (GLenum a, GLuint b), (a, b))
GL_SETTING(known_capability(a, true), void, glEnable, (GLenum a), (a))
GL_CALL(CALL_OTHER, void, glEnableVertexArrayAttrib, (GLuint a, GLuint b), (a, b))
GL_SETTING(unknown_capability(a), void, glEnablei, (GLenum a, GLuint b), (a, b))
GL_CALL(CALL_OTHER, void, glEndConditionalRender, (void), ())
GL_CALL(CALL_OTHER, void, glEndQuery, (GLenum a), (a))
GL_CALL(CALL_OTHER, void, glEndTransformFeedback, (void), ())
GL_CALL(CALL_OTHER, GLsync, glFenceSync, (GLenum a, GLbitfield b), (a, b))
GL_CALL(CALL_WAIT, void, glFinish, (void), ())
GL_CALL(CALL_OTHER, void, glFlush, (void), ())
GL_SETTING(KNOWN(FRONT, a), void, glFrontFace, (GLenum a), (a))
GL_CALL(CALL_OTHER, void, glGenQueries, (GLsizei a, GLuint *b), (a, b))
GL_CALL(CALL_OTHER, void, glGenTextures, (GLsizei a, GLuint *b), (a, b))
GL_CALL(CALL_OTHER, void, glGenerateTextureMipmap, (GLuint a), (a))
GL_CALL(CALL_QUESTION, void, glGetAttachedShaders, (GLuint a, GLsizei b, GLsizei *c, GLuint *d), (a, b, c, d))
GL_CALL(CALL_QUESTION, void, glGetBooleanv, (GLenum a, GLboolean *b), (a, b))
GL_CALL(CALL_QUESTION, GLenum, glGetError, (void), ())
GL_CALL(CALL_QUESTION, void, glGetFloatv, (GLenum a, GLfloat *b), (a, b))
GL_CALL(CALL_QUESTION, void, glGetInteger64v, (GLenum a, GLint64 *b), (a, b))
GL_CALL(CALL_QUESTION, void, glGetIntegerv, (GLenum a, GLint *b), (a, b))
GL_CALL(CALL_READBACK, void, glGetNamedBufferSubData, (GLuint a, GLintptr b, GLsizeiptr c, void *d),
        (a, b, c, d))
GL_CALL(CALL_QUESTION, void, glGetObjectLabel, (GLenum a, GLuint b, GLsizei c, GLsizei *d, GLchar *e),
        (a, b, c, d, e))
GL_CALL(CALL_OTHER, void, glGetProgramBinary, (GLuint a, GLsizei b, GLsizei *c, GLenum *d, void *e),
        (a, b, c, d, e))
GL_CALL(CALL_QUESTION, void, glGetProgramInfoLog, (GLuint a, GLsizei b, GLsizei *c, GLchar *d), (a, b, c, d))
GL_CALL(CALL_QUESTION, GLuint, glGetProgramResourceIndex, (GLuint a, GLenum b, const GLchar *c), (a, b, c))
GL_CALL(CALL_QUESTION, void, glGetProgramResourceiv,
        (GLuint a, GLenum b, GLuint c, GLsizei d, const GLenum *e, GLsizei f, GLsizei *g, GLint *h),
        (a, b, c, d, e, f, g, h))
GL_CALL(CALL_QUESTION, void, glGetProgramiv, (GLuint a, GLenum b, GLint *c), (a, b, c))
GL_CALL(CALL_QUESTION, void, glGetQueryObjectiv, (GLuint a, GLenum b, GLint *c), (a, b, c))
GL_CALL(CALL_QUESTION, void, glGetQueryObjectui64v, (GLuint a, GLenum b, GLuint64 *c), (a, b, c))
GL_CALL(CALL_QUESTION, void, glGetQueryObjectuiv, (GLuint a, GLenum b, GLuint *c), (a, b, c))
GL_CALL(CALL_QUESTION, void, glGetShaderInfoLog, (GLuint a, GLsizei b, GLsizei *c, GLchar *d), (a, b, c, d))
GL_CALL(CALL_QUESTION, void, glGetShaderiv, (GLuint a, GLenum b, GLint *c), (a, b, c))
GL_CALL(CALL_QUESTION, const GLubyte *, glGetString, (GLenum a), (a))
GL_CALL(CALL_QUESTION, void, glGetTexLevelParameteriv, (GLenum a, GLint b, GLenum c, GLint *d), (a, b, c, d))
GL_CALL(pixels_read(), void, glGetTextureImage, (GLuint a, GLint b, GLenum c, GLenum d, GLsizei e, void *f),
        (a, b, c, d, e, f))
GL_CALL(pixels_read(), void, glGetTextureSubImage,
        (GLuint a, GLint b, GLint c, GLint d, GLint e, GLsizei f, GLsizei g, GLsizei h, GLenum i, GLenum j,
         GLsizei k, void *l),
        (a, b, c, d, e, f, g, h, i, j, k, l))
GL_CALL(CALL_QUESTION, GLint, glGetUniformLocation, (GLuint a, const GLchar *b), (a, b))
GL_CALL(CALL_QUESTION, GLboolean, glIsEnabled, (GLenum a), (a))
GL_CALL(CALL_QUESTION, GLboolean, glIsProgram, (GLuint a), (a))
GL_SETTING(unknown_uniforms(a), void, glLinkProgram, (GLuint a), (a))
GL_CALL(CALL_OTHER, void *, glMapNamedBufferRange, (GLuint a, GLintptr b, GLsizeiptr c, GLbitfield d),
        (a, b, c, d))
GL_CALL(CALL_OTHER, void, glMaxShaderCompilerThreadsARB, (GLuint a), (a))
GL_CALL(CALL_OTHER, void, glMaxShaderCompilerThreadsKHR, (GLuint a), (a))
GL_SETTING(put_off(a), void, glMemoryBarrier, (GLbitfield a), (a))
GL_CALL(CALL_OTHER, void, glNamedBufferData, (GLuint a, GLsizeiptr b, const void *c, GLenum d), (a, b, c, d))
GL_CALL(CALL_OTHER, void, glNamedBufferStorage, (GLuint a, GLsizeiptr b, const void *c, GLbitfield d),
        (a, b, c, d))
GL_CALL(sent(c), void, glNamedBufferSubData, (GLuint a, GLintptr b, GLsizeiptr c, const void *d),
        (a, b, c, d))
GL_CALL(CALL_OTHER, void, glNamedFramebufferDrawBuffer, (GLuint a, GLenum b), (a, b))
GL_CALL(CALL_OTHER, void, glNamedFramebufferDrawBuffers, (GLuint a, GLsizei b, const GLenum *c), (a, b, c))
GL_CALL(CALL_OTHER, void, glNamedFramebufferTexture, (GLuint a, GLenum b, GLuint c, GLint d), (a, b, c, d))
GL_CALL(CALL_OTHER, void, glNamedFramebufferTextureLayer, (GLuint a, GLenum b, GLuint c, GLint d, GLint e),
        (a, b, c, d, e))
GL_CALL(CALL_OTHER, void, glObjectLabel, (GLenum a, GLuint b, GLsizei c, const GLchar *d), (a, b, c, d))
GL_CALL(CALL_OTHER, void, glPixelStorei, (GLenum a, GLint b), (a, b))
GL_CALL(CALL_OTHER, void, glPointSize, (GLfloat a), (a))
GL_CALL(CALL_OTHER, void, glPolygonMode, (GLenum a, GLenum b), (a, b))
GL_SETTING(unknown_uniforms(a), void, glProgramBinary, (GLuint a, GLenum b, const void *c, GLsizei d),
           (a, b, c, d))
GL_CALL(CALL_OTHER, void, glProgramParameteri, (GLuint a, GLenum b, GLint c), (a, b, c))
GL_SETTING(known_uniform(a, b, 1, 1, (GLfloat[]){c}), void, glProgramUniform1f,
           (GLuint a, GLint b, GLfloat c), (a, b, c))
GL_SETTING(known_uniform(a, b, 1, 1, (GLint[]){c}), void, glProgramUniform1i, (GLuint a, GLint b, GLint c),
           (a, b, c))
GL_SETTING(known_uniform(a, b, 1, 1, (GLuint[]){c}), void, glProgramUniform1ui, (GLuint a, GLint b, GLuint c),
           (a, b, c))
GL_SETTING(known_uniform(a, b, 1, c, d), void, glProgramUniform1uiv,
           (GLuint a, GLint b, GLsizei c, const GLuint *d), (a, b, c, d))
GL_SETTING(known_uniform(a, b, 2, 1, (GLfloat[]){c, d}), void, glProgramUniform2f,
           (GLuint a, GLint b, GLfloat c, GLfloat d), (a, b, c, d))
GL_SETTING(known_uniform(a, b, 2, 1, (GLint[]){c, d}), void, glProgramUniform2i,
           (GLuint a, GLint b, GLint c, GLint d), (a, b, c, d))
GL_SETTING(known_uniform(a, b, 3, 1, (GLfloat[]){c, d, e}), void, glProgramUniform3f,
           (GLuint a, GLint b, GLfloat c, GLfloat d, GLfloat e), (a, b, c, d, e))
GL_SETTING(known_uniform(a, b, 3, c, d), void, glProgramUniform3fv,
           (GLuint a, GLint b, GLsizei c, const GLfloat *d), (a, b, c, d))
GL_SETTING(known_uniform(a, b, 3, 1, (GLuint[]){c, d, e}), void, glProgramUniform3ui,
           (GLuint a, GLint b, GLuint c, GLuint d, GLuint e), (a, b, c, d, e))
GL_SETTING(known_uniform(a, b, 4, 1, (GLfloat[]){c, d, e, f}), void, glProgramUniform4f,
           (GLuint a, GLint b, GLfloat c, GLfloat d, GLfloat e, GLfloat f), (a, b, c, d, e, f))
GL_SETTING(known_uniform(a, b, 4, c, d), void, glProgramUniform4fv,
           (GLuint a, GLint b, GLsizei c, const GLfloat *d), (a, b, c, d))
GL_SETTING(known_uniform(a, b, 4, 1, (GLuint[]){c, d, e, f}), void, glProgramUniform4ui,
           (GLuint a, GLint b, GLuint c, GLuint d, GLuint e, GLuint f), (a, b, c, d, e, f))
GL_CALL(CALL_OTHER, void, glQueryCounter, (GLuint a, GLenum b), (a, b))
GL_CALL(CALL_OTHER, void, glReadBuffer, (GLenum a), (a))
GL_CALL(pixels_read(), void, glReadPixels,
        (GLint a, GLint b, GLsizei c, GLsizei d, GLenum e, GLenum f, void *g), (a, b, c, d, e, f, g))
GL_SETTING(KNOWN(SCISSOR, (uint32_t)a, (uint32_t)b, (uint32_t)c, (uint32_t)d), void, glScissor,
           (GLint a, GLint b, GLsizei c, GLsizei d), (a, b, c, d))
GL_CALL(CALL_OTHER, void, glShaderSource, (GLuint a, GLsizei b, const GLchar *const *c, const GLint *d),
        (a, b, c, d))
GL_CALL(CALL_OTHER, void, glStencilFunc, (GLenum a, GLint b, GLuint c), (a, b, c))
GL_CALL(CALL_OTHER, void, glStencilMask, (GLuint a), (a))
GL_CALL(CALL_OTHER, void, glStencilOp, (GLenum a, GLenum b, GLenum c), (a, b, c))
GL_CALL(CALL_OTHER, void, glTexImage3D,
        (GLenum a, GLint b, GLint c, GLsizei d, GLsizei e, GLsizei f, GLint g, GLenum h, GLenum i,
         const void *j),
        (a, b, c, d, e, f, g, h, i, j))
GL_CALL(CALL_BARRIER, void, glTextureBarrier, (void), ())
GL_CALL(CALL_OTHER, void, glTextureBuffer, (GLuint a, GLenum b, GLuint c), (a, b, c))
GL_CALL(CALL_OTHER, void, glTextureParameteri, (GLuint a, GLenum b, GLint c), (a, b, c))
GL_CALL(CALL_OTHER, void, glTextureStorage2D, (GLuint a, GLsizei b, GLenum c, GLsizei d, GLsizei e),
        (a, b, c, d, e))
GL_CALL(CALL_OTHER, void, glTextureStorage3D,
        (GLuint a, GLsizei b, GLenum c, GLsizei d, GLsizei e, GLsizei f), (a, b, c, d, e, f))
GL_CALL(CALL_OTHER, void, glTextureSubImage2D,
        (GLuint a, GLint b, GLint c, GLint d, GLsizei e, GLsizei f, GLenum g, GLenum h, const void *i),
        (a, b, c, d, e, f, g, h, i))
GL_CALL(CALL_OTHER, void, glTextureSubImage3D,
        (GLuint a, GLint b, GLint c, GLint d, GLint e, GLsizei f, GLsizei g, GLsizei h, GLenum i, GLenum j,
         const void *k),
        (a, b, c, d, e, f, g, h, i, j, k))
GL_CALL(CALL_OTHER, void, glTextureView,
        (GLuint a, GLenum b, GLuint c, GLenum d, GLuint e, GLuint f, GLuint g, GLuint h),
        (a, b, c, d, e, f, g, h))
GL_CALL(CALL_OTHER, void, glTransformFeedbackBufferBase, (GLuint a, GLuint b, GLuint c), (a, b, c))
GL_CALL(CALL_OTHER, void, glTransformFeedbackVaryings,
        (GLuint a, GLsizei b, const GLchar *const *c, GLenum d), (a, b, c, d))
GL_SETTING(known_uniform(known_program(), a, 1, 1, (GLfloat[]){b}), void, glUniform1f, (GLint a, GLfloat b),
           (a, b))
GL_SETTING(known_uniform(known_program(), a, 1, b, c), void, glUniform1fv,
           (GLint a, GLsizei b, const GLfloat *c), (a, b, c))
GL_SETTING(known_uniform(known_program(), a, 1, 1, (GLint[]){b}), void, glUniform1i, (GLint a, GLint b),
           (a, b))
GL_SETTING(known_uniform(known_program(), a, 1, 1, (GLuint[]){b}), void, glUniform1ui, (GLint a, GLuint b),
           (a, b))
GL_SETTING(known_uniform(known_program(), a, 2, 1, (GLfloat[]){b, c}), void, glUniform2f,
           (GLint a, GLfloat b, GLfloat c), (a, b, c))
GL_SETTING(known_uniform(known_program(), a, 2, b, c), void, glUniform2fv,
           (GLint a, GLsizei b, const GLfloat *c), (a, b, c))
GL_SETTING(known_uniform(known_program(), a, 2, 1, (GLint[]){b, c}), void, glUniform2i,
           (GLint a, GLint b, GLint c), (a, b, c))
GL_SETTING(known_uniform(known_program(), a, 2, 1, (GLuint[]){b, c}), void, glUniform2ui,
           (GLint a, GLuint b, GLuint c), (a, b, c))
GL_SETTING(known_uniform(known_program(), a, 2, b, c), void, glUniform2uiv,
           (GLint a, GLsizei b, const GLuint *c), (a, b, c))
GL_SETTING(known_uniform(known_program(), a, 3, 1, (GLfloat[]){b, c, d}), void, glUniform3f,
           (GLint a, GLfloat b, GLfloat c, GLfloat d), (a, b, c, d))
GL_SETTING(known_uniform(known_program(), a, 3, b, c), void, glUniform3fv,
           (GLint a, GLsizei b, const GLfloat *c), (a, b, c))
GL_SETTING(known_uniform(known_program(), a, 3, 1, (GLint[]){b, c, d}), void, glUniform3i,
           (GLint a, GLint b, GLint c, GLint d), (a, b, c, d))
GL_SETTING(known_uniform(known_program(), a, 3, 1, (GLuint[]){b, c, d}), void, glUniform3ui,
           (GLint a, GLuint b, GLuint c, GLuint d), (a, b, c, d))
GL_SETTING(known_uniform(known_program(), a, 3, b, c), void, glUniform3uiv,
           (GLint a, GLsizei b, const GLuint *c), (a, b, c))
GL_SETTING(known_uniform(known_program(), a, 4, 1, (GLfloat[]){b, c, d, e}), void, glUniform4f,
           (GLint a, GLfloat b, GLfloat c, GLfloat d, GLfloat e), (a, b, c, d, e))
GL_SETTING(known_uniform(known_program(), a, 4, b, c), void, glUniform4fv,
           (GLint a, GLsizei b, const GLfloat *c), (a, b, c))
GL_SETTING(known_uniform(known_program(), a, 4, b, c), void, glUniform4iv,
           (GLint a, GLsizei b, const GLint *c), (a, b, c))
GL_CALL(CALL_OTHER, void, glUniformMatrix3fv, (GLint a, GLsizei b, GLboolean c, const GLfloat *d),
        (a, b, c, d))
GL_CALL(CALL_OTHER, void, glUniformMatrix4fv, (GLint a, GLsizei b, GLboolean c, const GLfloat *d),
        (a, b, c, d))
GL_CALL(CALL_OTHER, GLboolean, glUnmapNamedBuffer, (GLuint a), (a))
GL_SETTING(KNOWN(PROGRAM, a), void, glUseProgram, (GLuint a), (a))
GL_CALL(CALL_OTHER, void, glVertexArrayAttribBinding, (GLuint a, GLuint b, GLuint c), (a, b, c))
GL_CALL(CALL_OTHER, void, glVertexArrayAttribFormat,
        (GLuint a, GLuint b, GLint c, GLenum d, GLboolean e, GLuint f), (a, b, c, d, e, f))
GL_CALL(CALL_OTHER, void, glVertexArrayAttribIFormat, (GLuint a, GLuint b, GLint c, GLenum d, GLuint e),
        (a, b, c, d, e))
GL_CALL(CALL_OTHER, void, glVertexArrayElementBuffer, (GLuint a, GLuint b), (a, b))
GL_CALL(CALL_OTHER, void, glVertexArrayVertexBuffer, (GLuint a, GLuint b, GLuint c, GLintptr d, GLsizei e),
        (a, b, c, d, e))
GL_SETTING(KNOWN(VIEWPORT, (uint32_t)a, (uint32_t)b, (uint32_t)c, (uint32_t)d), void, glViewport,
           (GLint a, GLint b, GLsizei c, GLsizei d), (a, b, c, d))

#undef GL_RUN
#undef GL_SETTING
