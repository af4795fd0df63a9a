/* SPDX-License-Identifier: Apache-2.0 */
/* The subcommands, one file cmd_NAME.c each. */
#ifndef SRP_CLI_COMMANDS_H
#define SRP_CLI_COMMANDS_H

#include "command.h"

extern const cli_command cli_command_info;
extern const cli_command cli_command_force;
extern const cli_command cli_command_table;
extern const cli_command cli_command_reoptic;
extern const cli_command cli_command_convert;
extern const cli_command cli_command_plot;
extern const cli_command cli_command_picture;
extern const cli_command cli_command_compare;
extern const cli_command cli_command_fit_nplate;
#ifdef SRP_CLI_HAS_ORBIT /* the propagator was built */
extern const cli_command cli_command_propagate;
#endif
extern const cli_command cli_command_cache;

#endif
