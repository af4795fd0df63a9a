/* SPDX-License-Identifier: Apache-2.0 */
/* Marks of the public interface: symbol visibility, C linkage, results that must be looked at. */
#ifndef SRP_EXPORT_H
#define SRP_EXPORT_H

#ifdef __cplusplus
#define SRP_BEGIN_DECLS extern "C" {
#define SRP_END_DECLS }
#else
#define SRP_BEGIN_DECLS
#define SRP_END_DECLS
#endif

#if defined(__GNUC__) || defined(__clang__)
#define SRP_API __attribute__((visibility("default")))
#define SRP_CHECK __attribute__((warn_unused_result))
#define SRP_PRINTF(format_index, first_argument)                                                   \
    __attribute__((format(printf, format_index, first_argument)))
#else
#define SRP_API
#define SRP_CHECK
#define SRP_PRINTF(format_index, first_argument)
#endif

#endif
