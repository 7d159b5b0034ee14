# facet_embed(TARGET target SYMBOL some::name FILES a.h b.cl ...)
#
# Adds to `target` a generated source that defines
#   const facet::runtime::source_tree& some::name();
# with the text of FILES under their names without folders. It is made anew when one of them
# changes. Declare the function where it is used; the target must link facet::runtime.
set(FACET_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_write.cmake)

function(facet_embed)
  cmake_parse_arguments(ARG "" "TARGET;SYMBOL" "FILES" ${ARGN})
  if(NOT ARG_TARGET OR NOT ARG_SYMBOL OR NOT ARG_FILES OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "facet_embed: give TARGET, SYMBOL and FILES")
  endif()
  set(paths)
  set(names)
  foreach(file ${ARG_FILES})
    get_filename_component(path ${file} ABSOLUTE)
    get_filename_component(name ${file} NAME)
    if(name IN_LIST names)
      message(FATAL_ERROR "facet_embed: two files are named ${name}")
    endif()
    list(APPEND paths ${path})
    list(APPEND names ${name})
  endforeach()
  string(REPLACE "::" "_" stem ${ARG_SYMBOL})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${stem}.embed.cpp)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DSYMBOL=${ARG_SYMBOL}" "-DFILES=${paths}"
            -P ${FACET_EMBED_SCRIPT}
    DEPENDS ${paths} ${FACET_EMBED_SCRIPT}
    COMMENT "Embedding ${stem}"
    VERBATIM)
  target_sources(${ARG_TARGET} PRIVATE ${output})
endfunction()
