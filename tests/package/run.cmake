# Installs the build into a folder of its own, builds a project that finds it there, and runs it.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGV}: ${code}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_BUILD_TYPE=Release -G ${GENERATOR})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
# The program where it is installed finds its part for picture files, if it has one.
if(EXISTS ${BUILD}/facet_pictures.so)
  file(WRITE ${WORK}/box.json [=[{"meshes": {"box": {"generate": "box"}}, "instances": [{"mesh": "box"}]}]=])
  run(${WORK}/prefix/bin/facet render ${WORK}/box.json --device serial --width 16 -o ${WORK}/box.png)
endif()
