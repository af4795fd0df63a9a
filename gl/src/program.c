/* SPDX-License-Identifier: Apache-2.0 */
#include "program.h"

#include "error.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { LOG_SIZE = 600, STAGES_MAX = 2 };

/* The line that a log begins with: "1:12(5): error" (Mesa), "1(12) : error" (NVIDIA), "ERROR:
 * 1:12:" (others), 1 being the number of our source; 0: it does not say. */
static size_t line_of(const char *log) {
    for (const char *at = log; *at != '\0'; ++at) {
        if (isdigit((unsigned char)at[0]) && (at[1] == ':' || at[1] == '(') &&
            isdigit((unsigned char)at[2])) {
            return strtoul(at + 2, NULL, 10);
        }
    }
    return 0;
}

/* One line without the break at its end. */
static void trim(char *log) {
    size_t length = strlen(log);
    while (length > 0 && isspace((unsigned char)log[length - 1])) {
        log[--length] = '\0';
    }
}

static srp_status compile(const srp_gl_context *context, const char *prelude,
                          const srp_gl_stage *stage, GLuint *out, srp_error *error) {
    const srp_gl_functions *gl = &context->gl;
    const GLchar *texts[3] = {prelude, "#line 1\n", stage->source->text};
    GLuint shader = gl->CreateShader(stage->kind);
    GLint compiled = GL_FALSE;
    gl->ShaderSource(shader, 3, texts, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        char log[LOG_SIZE] = "no reason given";
        gl->GetShaderInfoLog(shader, LOG_SIZE, NULL, log);
        gl->DeleteShader(shader);
        trim(log);
        return srp_fail_at(error, SRP_NO_DEVICE, stage->source->file, line_of(log), 0,
                           "%s cannot compile it: %s", context->renderer, log);
    }
    *out = shader;
    return SRP_OK;
}

static srp_status link_program(const srp_gl_context *context, const srp_gl_stage *stages,
                               GLuint program, srp_error *error) {
    GLint linked = GL_FALSE;
    context->gl.LinkProgram(program);
    context->gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        char log[LOG_SIZE] = "no reason given";
        context->gl.GetProgramInfoLog(program, LOG_SIZE, NULL, log);
        trim(log);
        return srp_fail_at(error, SRP_NO_DEVICE, stages[0].source->file, 0, 0,
                           "%s cannot link it: %s", context->renderer, log);
    }
    return SRP_OK;
}

srp_status srp_gl_program_create(const srp_gl_context *context, const char *prelude,
                                 const srp_gl_stage *stages, size_t count, GLuint *out,
                                 srp_error *error) {
    const srp_gl_functions *gl = &context->gl;
    GLuint shaders[STAGES_MAX] = {0};
    GLuint program = gl->CreateProgram();
    srp_status status = SRP_OK;
    for (size_t k = 0; k < count && status == SRP_OK; ++k) {
        status = compile(context, prelude, &stages[k], &shaders[k], error);
        if (status == SRP_OK) {
            gl->AttachShader(program, shaders[k]);
        }
    }
    if (status == SRP_OK) {
        status = link_program(context, stages, program, error);
    }
    for (size_t k = 0; k < count; ++k) {
        gl->DeleteShader(shaders[k]); /* 0 is none */
    }
    if (status != SRP_OK) {
        gl->DeleteProgram(program);
        return status;
    }
    *out = program;
    return SRP_OK;
}
