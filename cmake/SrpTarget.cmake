# SPDX-License-Identifier: Apache-2.0
# What every target of ours is compiled with.

# In either language.
function(srp_common_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
  if(SRP_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(SRP_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${SRP_SANITIZE} -fno-omit-frame-pointer
                                             -fno-sanitize-recover=all)
    target_link_options(${target} PRIVATE -fsanitize=${SRP_SANITIZE})
    # Run-time dispatch resolves before a sanitizer is up.
    target_compile_definitions(${target} PRIVATE SRP_NO_TARGET_CLONES)
  endif()
endfunction()

# C11.
function(srp_target_options target)
  srp_common_options(${target})
  target_compile_options(${target} PRIVATE -Wstrict-prototypes -Wmissing-prototypes -Wvla)
  set_target_properties(${target} PROPERTIES C_VISIBILITY_PRESET hidden)
endfunction()

# C++17.
function(srp_cxx_target_options target)
  srp_common_options(${target})
  set_target_properties(${target} PROPERTIES CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON
    CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden)
endfunction()
