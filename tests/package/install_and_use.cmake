# Installs a build, then builds and runs a project that finds it.
#     cmake -D BUILD=... -D USER=folder of the project -D WORK=... -D README=... -D FLAGS=... -P this
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/examples)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(awk -v out=${WORK}/examples -f ${CMAKE_CURRENT_LIST_DIR}/examples.awk ${README})
run(${CMAKE_COMMAND} -S ${USER} -B ${WORK}/build -G Ninja -D CMAKE_PREFIX_PATH=${WORK}/prefix
    -D CMAKE_BUILD_TYPE=Release -D CMAKE_CXX_FLAGS=${FLAGS} -D EXAMPLES=${WORK}/examples)
run(${CMAKE_COMMAND} --build ${WORK}/build)
execute_process(COMMAND ${WORK}/build/consumer WORKING_DIRECTORY ${WORK}
                COMMAND_ERROR_IS_FATAL ANY)
