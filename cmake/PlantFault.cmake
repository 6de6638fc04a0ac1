# cmake -DSOURCE=shaders -DTARGET=folder -DFILE=sphere.glsl -DFROM=text -DTO=text -P PlantFault.cmake
#
# Copies a folder and replaces the first occurrence of a text in one of its files: how tests get faulty kernels.
file(REMOVE_RECURSE ${TARGET})
file(COPY ${SOURCE}/ DESTINATION ${TARGET})
file(READ ${TARGET}/${FILE} text)
string(FIND "${text}" "${FROM}" position)
if(position EQUAL -1)
    message(FATAL_ERROR "${FILE} does not contain '${FROM}': give the planted fault another place")
endif()
string(LENGTH "${FROM}" length)
math(EXPR end "${position} + ${length}")
string(SUBSTRING "${text}" 0 ${position} before)
string(SUBSTRING "${text}" ${end} -1 after)
file(WRITE ${TARGET}/${FILE} "${before}${TO}${after}")
