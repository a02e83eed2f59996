# SPDX-License-Identifier: Apache-2.0
set(kerf_embed_script ${CMAKE_CURRENT_LIST_DIR}/embed_text.cmake)

# kerf_embed_text(kerf_session kerf::session::report_style page/report.css)  → `extern const std::string_view kerf::session::report_style;`
# The text is part of the library. It is embedded again when the file changes.
function(kerf_embed_text target name file)
  set(input ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${file}.cpp)
  get_filename_component(folder ${output} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D INPUT=${input} -D OUTPUT=${output} -D NAME=${name} -P ${kerf_embed_script}
    DEPENDS ${input} ${kerf_embed_script} COMMENT "Embedding ${file}" VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
